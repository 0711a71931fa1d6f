#include <fmt/format.h>

#include "core/error.h"
#include "film/image_io.h"
#include "reference/reference.h"

namespace bench {

std::filesystem::path ReferenceStore::part(const std::string& key, int index) const {
  return m_root / key / fmt::format("part-{:04}.exr", index);
}

bool ReferenceStore::hasPart(const std::string& key, int index) const {
  return std::filesystem::exists(part(key, index));
}

void ReferenceStore::savePart(const std::string& key, int index, const pt::Image& image) const {
  std::filesystem::create_directories(part(key, index).parent_path());
  pt::writeExr(part(key, index), image);
}

std::vector<pt::Image> ReferenceStore::loadParts(const std::string& key, int count) const {
  std::vector<pt::Image> parts;
  for (int i = 0; i < count; ++i) {
    parts.push_back(pt::readImage(part(key, i)));
    if (parts.back().width != parts.front().width || parts.back().height != parts.front().height)
      throw pt::InputError(fmt::format("{}: differs in size from the other parts; remove the folder {}",
                                       part(key, i).string(), part(key, i).parent_path().string()));
  }
  return parts;
}

}  // namespace bench
