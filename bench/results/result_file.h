// Files of results: one JSON document each, small and stable under diffs. Names are sorted, numbers have four
// significant digits, and each metric and each check is one line. There is no date in it: the same figures
// give the same file.
//
// {"format":1, "kind":"bench", "name":"carve", "runs":3, "options":{…}, "machine":{…}, "conditions":{…},
//  "metrics":{"tick_p99_ms":{"value":1.5,"min":1.4,"max":1.6}, …},
//  "checks":{"pieces":{"passed":true,"detail":"…"}, …}}
#pragma once

#include <string>
#include <string_view>

#include "bench/results/stored_result.h"
#include "shared/base/result.h"

namespace scree {

/// Raised when a reader of the old format would misread a file of the new one.
inline constexpr int result_format = 1;

/// Larger files are refused: one of a thousand metrics takes 100 KB.
inline constexpr size_t result_bytes_max = size_t{4} << 20U;

std::string to_json(const StoredResult& result);

/// Everything is checked; the error says what is wrong, with the name of the member.
Result<StoredResult> parse_result(std::string_view text);

/// Folders are made if need be; the file appears under its name when it is whole.
Result<void> write_result(const StoredResult& result, const std::string& path);

/// The error names the file.
Result<StoredResult> read_result(const std::string& path);

/// All files NAME.json of a folder, by name. An error if one is damaged, is named otherwise than its result,
/// or if there is none.
Result<std::map<std::string, StoredResult>> read_results(const std::string& folder);

}  // namespace scree
