#pragma once

#include <string>
#include <string_view>

namespace pt {

/// Bytes of base64 text [RFC 4648]; other characters (line breaks, padding) are passed over.
std::string decodeBase64(std::string_view text);

}  // namespace pt
