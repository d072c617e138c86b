// Numbers as people write them, for messages: no exponents, and no more digits than say something.
#pragma once

#include <string>

namespace scree {

/// "0.01", "12.5", "1,000,000", five digits of a fraction at most; "no number" of what is not finite.
std::string plain(double number);

/// "from 0.01 to 16 m". The unit may be empty.
std::string range_text(double least, double most, const std::string& unit);

/// "20 m"; the number alone where there is no unit.
std::string with_unit(double number, const std::string& unit);
std::string metres(double length);

}  // namespace scree
