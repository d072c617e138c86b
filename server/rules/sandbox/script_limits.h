// Limits of scripts. ScriptOptions holds those that a host chooses.
#pragma once

#include <cstddef>
#include <cstdint>

namespace scree {

/// What a host may give one script. A machine with its library takes 60 KiB.
inline constexpr size_t script_memory_min_bytes = size_t{256} << 10U;
inline constexpr size_t script_memory_max_bytes = size_t{256} << 20U;

/// Bytes of one text. Lua compares texts without a hook, 6 ns a byte where they are full of zeros; and one
/// instruction joins up to 250 of them, 16 MB. Over it, the script ends with out_of_memory.
inline constexpr size_t script_text_bytes_max = size_t{64} << 10U;
/// Any other block: a list of 65,536 items, a table of 32,768 names. Growth doubles a block without a hook,
/// so the one that is over is still granted, and the script ends with out_of_memory.
inline constexpr size_t script_block_bytes_max = size_t{1} << 20U;

/// Instructions between two looks at the budget, at most. A look takes 60 ns, 100 instructions 600 ns.
inline constexpr int script_interval = 100;
/// Bytes that those instructions may compare in all: their number is less where longer texts exist. 1 to 2
/// ms.
inline constexpr size_t script_interval_bytes = size_t{256} << 10U;
/// Bytes granted between two looks.
inline constexpr size_t script_interval_granted_bytes = size_t{256} << 10U;
/// Bytes that count as one unit of work, where they are granted or touched.
inline constexpr size_t script_bytes_per_work = 16;

/// The longest file that load() or require() reads.
inline constexpr size_t script_file_bytes_max = size_t{1} << 20U;
/// The longest name that require() gets.
inline constexpr size_t script_path_bytes_max = 128;
/// The compiler gets its text in pieces, with a look at the budget between: it is quadratic in some texts.
inline constexpr size_t script_piece_bytes = 512;

/// The longest pattern; a longer one would compile to a program that is slow to run.
inline constexpr size_t script_pattern_bytes_max = 256;
/// Memory of RE2 for one pattern, counted as the script's.
inline constexpr size_t script_pattern_memory_bytes = size_t{128} << 10U;
/// Compiled patterns that a script keeps at hand.
inline constexpr int script_patterns_kept = 16;

/// The longest line of print(), and the longest value that run() shows.
inline constexpr size_t script_print_bytes_max = 1024;
inline constexpr size_t script_traceback_lines_max = 20;
/// Tables in tables of kept values.
inline constexpr int script_json_depth_max = 32;

}  // namespace scree
