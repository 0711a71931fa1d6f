#pragma once

#include <filesystem>
#include <functional>
#include <string_view>

namespace pt {

/// Writes a file such that an old one is never lost to a failure: `write` fills a temporary file beside `target` (of
/// the same ending), which then takes the place of `target`. If `write` throws, the temporary file is removed and
/// `target` stays as it was. Throws WorkError when the file cannot be put in place.
void replaceFile(const std::filesystem::path& target,
                 const std::function<void(const std::filesystem::path& temporary)>& write);

/// The same with the content at hand.
void replaceFile(const std::filesystem::path& target, std::string_view bytes);

/// Throws InputError or WorkError unless replaceFile(target) has good prospects: to be called before hours of work.
void requireReplaceable(const std::filesystem::path& target);

}  // namespace pt
