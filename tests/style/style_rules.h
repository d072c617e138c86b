// House rules that a program can check: layering, homes of libraries, lengths, header guards, no libm in
// kernels. Pure functions of a file's path and text; each returns what is wrong, in words for a person.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace scree::style {

/// Lines; beyond, a file holds more than one concept and a function more than one thought.
inline constexpr size_t file_lines_max = 400;
inline constexpr size_t function_lines_max = 70;

/// Path from the project's root ("shared/field/brick.h"), with '/', and the text.
struct SourceFile {
  std::string path;
  std::string text;
};

using Complaints = std::vector<std::string>;

/// What is included, as written between the quotes or angle brackets.
struct Include {
  std::string target;
  bool angled = false;
};
std::vector<Include> includes_of(const SourceFile& file);

/// Code with comments, literals and preprocessor lines blanked; line breaks stay where they were.
std::string without_comments_and_literals(std::string_view text);

Complaints check_file_length(const SourceFile& file);
Complaints check_function_lengths(const SourceFile& file);
Complaints check_pragma_once(const SourceFile& file);
/// Project includes point downwards, and are paths from the root.
Complaints check_layering(const SourceFile& file);
/// Each library is included in its home folders only; shared/ knows three small ones.
Complaints check_library_homes(const SourceFile& file);
/// A header that includes a homed library is included from the library's homes only.
Complaints check_library_leaks(const std::vector<SourceFile>& files);
/// No two headers define a class of the same name in `scree`: linked together, each would be used for the
/// other.
Complaints check_class_names(const std::vector<SourceFile>& files);
/// Kernels use + − × ÷ and sqrt only: a math library's other functions differ from system to system.
Complaints check_kernel_arithmetic(const SourceFile& file);
/// No file but a table of methods asks which cutter, merge, pattern, collider, simplifier or drawing method
/// it has: the rows say in what methods differ.
Complaints check_methods_are_asked(const SourceFile& file);

}  // namespace scree::style
