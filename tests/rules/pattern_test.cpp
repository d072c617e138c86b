// Patterns beside those of Lua as it comes.
#include "shared/base/random.h"
#include "tests/rules/sandbox_support.h"
#include "tests/rules/stock_lua.h"

namespace scree {
namespace {

/// Joins all that find, match, gmatch and gsub give, with types, as hexadecimal texts.
constexpr const char* join_results = R"(
  local function hex(v) return type(v) .. ':' .. (tostring(v):gsub('.', function(c) return ('%02x'):format(c:byte()) end)) end
  local function joined(...)
    local t = {}
    for i = 1, select('#', ...) do t[i] = hex((select(i, ...))) end
    return table.concat(t, ' ')
  end
  local out = {}
  local function add(...) out[#out + 1] = joined(...) end
)";

/// As Lua's text, any bytes.
std::string quoted(const std::string& text) {
  std::string all = "'";
  for (const char c : text) {
    char escape[8];
    std::snprintf(escape, sizeof escape, "\\x%02x", static_cast<unsigned>(static_cast<unsigned char>(c)));
    all += escape;
  }
  return all + "'";
}

std::string questions(const std::string& text, const std::string& pattern) {
  const std::string both = quoted(text) + ", " + quoted(pattern);
  return std::string(join_results) + "local function try(f, ...) local r = table.pack(pcall(f, ...)) " +
         "if r[1] then add(table.unpack(r, 1, r.n)) else add('error') end end " +                 //
         "try(string.find, " + both + ") try(string.find, " + both + ", 2) " +                    //
         "try(string.match, " + both + ", -3) try(string.find, " + both + ", 1, true) " +         //
         "try(string.gsub, " + both + ", '<%0%%>') try(string.gsub, " + both + ", '%1', 2) " +    //
         "try(string.gsub, " + both + ", function(...) add(...) return nil end) " +               //
         "try(string.gsub, " + both + ", {a = 'A', b = false, ab = 1}) " +                        //
         "try(function() for a, b, c in string.gmatch(" + both + ") do add(a, b, c) end end) " +  //
         "return table.concat(out, '|')";
}

struct Case {
  const char* text;
  const char* pattern;
};

const Case cases[] = {
    {"hello world", "o"},
    {"hello world", "(%w+) (%w+)"},
    {"key = value", "^(%w+)%s*=%s*(%w+)$"},
    {"hello", "()ll()"},
    {"hello", "l*"},
    {"hello", ""},
    {"abc", "b-"},
    {"a.b.c", "%."},
    {"[x]", "[]]"},
    {"a-b", "[a-]+"},
    {"a-b^", "[%^%-]"},
    {"x^y", "[x^]"},
    {"aXb", "%u"},
    {"a\tb", "%s"},
    {"a1b2", "%d"},
    {"0x1F", "%x+"},
    {"a,b;c", "%p"},
    {"abc", "^b"},
    {"abc", "^a"},
    {"a^b", "a^b"},
    {"a$b", "a$b"},
    {"ab$", "b$$"},
    {"ab", "b$"},
    {"aaa", "a?a?a?a"},
    {"(foo)", "%((.-)%)"},
    {"f(a(b)c)", "%((.*)%)"},
    {"äöü", "[ä-ü]+"},
    {"a\nb", "a.b"},
    {"  trim  ", "^%s*(.-)%s*$"},
    {"2024-01-02", "(%d+)-(%d+)-(%d+)"},
    {"abab", "(a)(b)"},
    {"((a))", "((%w))"},
    {"a)", "a)"},
    {"[a", "[a"},
    {"[", "["},
    {"a", "[^"},
    {"]", "[^]]"},
    {"a]b", "[^%]]+"},
    {"%", "%%"},
    {"x*", "*"},
    {"x*", "x*"},
    {"x**", "x**"},
    {"a", "(a)*"},
    {"a*", "(a)*"},
    {"a-z", "[a-%z]"},
    {"a-z", "[%a-z]"},
    {"z-", "[z-]"},
    {"zzz", "z-$"},
    {"", ""},
    {"", "^"},
    {"", "$"},
    {"abc", "$"},
    {"abc", "^"},
    {"abc", "^$"},
    {"THE (quick) fox", "%((%a+)%)"},
    {"abc", "[%a]"},
    {"abc", "[^%a]"},
    {"abc1", "[^%A]"},
    {"a", "[]"},
    {"", "[^]"},
    {"ab", "[b-a]"},
    {"x", "[%]"},
    {"x]", "[%]]"},
    {"-", "[+--]"},
    {"one two  three", "%S+"},
    {"$name is $age", "%$(%w+)"},
    {"a,b,,c", "([^,]*)"},
};

TEST(Patterns, give_what_lua_gives) {
  Played played;
  StockLua stock;
  for (const auto& [text, pattern] : cases) {
    const std::string asked = questions(text, pattern);
    EXPECT_EQ(returned(played, asked), stock.ask(asked)) << text << " " << pattern;
  }
}

std::string random_text(Random& random, std::string_view from, uint32_t length_max) {
  std::string text;
  for (uint32_t left = random.below(length_max + 1); left > 0; --left)
    text += from[random.below(static_cast<uint32_t>(from.size()))];
  return text;
}

TEST(Patterns, give_what_lua_gives_for_random_ones) {
  Played played;
  StockLua stock;
  Random random(20);
  using namespace std::string_view_literals;
  int matches = 0;
  for (int i = 0; i < 4000; ++i) {
    const std::string text = random_text(random, "aaabbc1 -]^$.\0\xe4"sv, 12);
    std::string pattern;
    static constexpr std::string_view parts[] = {
        "a",   "b",      "c",      ".",    "%a", "%d",   "%s", "%W", "%p", "[ab]", "[^a]", "[a-c1]",
        "[]]", "[^%s-]", "[%d%]]", "*",    "+",  "-",    "?",  "(",  ")",  "()",   "^",    "$",
        "%%",  "%.",     "%]",     "[a-]", "%u", "\xe4", " ",  "%C", "%x", "[",    "]",    "%g"};
    for (uint32_t left = random.below(7); left > 0; --left)
      pattern += parts[random.below(static_cast<uint32_t>(std::size(parts)))];
    // Lua reads a wrong pattern only as far as it matches.
    const std::string asked = questions(text, pattern);
    const std::string ours = returned(played, asked);
    if (ours.find("error") != std::string::npos || ours.find("6572726f72") != std::string::npos) continue;
    ASSERT_EQ(ours, stock.ask(asked)) << quoted(text) << " " << pattern << " of pass " << i;
    if (ours.find("number:") != std::string::npos) ++matches;
  }
  EXPECT_GT(matches, 500);
}

TEST(Patterns, that_are_not_available_say_so) {
  Played played;
  EXPECT_EQ(played.ask("('x'):find('%bxy')"), "! console:1: %b in a pattern is not available here");
  EXPECT_EQ(played.ask("('x'):find('%f[x]')"), "! console:1: %f in a pattern is not available here");
  EXPECT_EQ(played.ask("('x'):find('(x)%1')"), "! console:1: %1 in a pattern is not available here");
  EXPECT_EQ(played.ask("('x'):find('(x')"), "! console:1: unfinished capture");
  EXPECT_EQ(played.ask("('x'):match('x)')"), "! console:1: invalid pattern capture");
  EXPECT_EQ(played.ask("('x'):find('[x')"), "! console:1: malformed pattern (missing ']')");
  EXPECT_EQ(played.ask("('x'):find('x%')"), "! console:1: malformed pattern (ends with '%')");
  EXPECT_EQ(played.ask("('x'):find(('.'):rep(300))"), "! console:1: a pattern is longer than 256 bytes");
  EXPECT_EQ(played.ask("('x'):find(('()'):rep(33))"), "! console:1: too many captures");
  EXPECT_EQ(played.ask("('x'):gsub('x', '%2')"),
            "! console:1: invalid capture index %2 in replacement string");
  EXPECT_EQ(played.ask("('x'):gsub('x', '%a')"), "! console:1: invalid use of '%' in replacement string");
  EXPECT_EQ(played.ask("('x'):gsub('x', {x = {}})"), "! console:1: invalid replacement value (a table)");
}

}  // namespace
}  // namespace scree
