#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "film/film.h"
#include "plan/plan.h"

namespace bench {

/// Do two estimators of the same picture have the same mean? Welch's test over the parts, of each tile and of the
/// whole.
struct Agreement {
  int tests = 0;
  double worstT = 0;          ///< largest |t| of any test
  double chanceOfWorst = 0;   ///< probability of a |t| as large in some test if the estimators agree (Sidak)
  double meanDifference = 0;  ///< of the whole picture, relative
  bool agrees() const { return chanceOfWorst > 1e-3; }
};

/// A reference and how far to trust it.
struct Reference {
  pt::Image image;
  std::int64_t spp = 0;
  double noise = 0;  ///< its own relMSE against the truth, estimated from two halves of its parts
};

/// Where parts of references lie: one folder each, named after the hash of all that they depend on.
class ReferenceStore {
 public:
  explicit ReferenceStore(std::filesystem::path root) : m_root(std::move(root)) {}

  std::filesystem::path part(const std::string& key, int index) const;
  bool hasPart(const std::string& key, int index) const;
  void savePart(const std::string& key, int index, const pt::Image& image) const;

  /// All parts. Throws pt::InputError if one is missing, unreadable or of another size.
  std::vector<pt::Image> loadParts(const std::string& key, int count) const;

 private:
  std::filesystem::path m_root;
};

/// Mean of the parts, and its noise.
Reference combineParts(const std::vector<pt::Image>& parts, std::int64_t sppPerPart);

/// Compares two estimators by their parts, in tiles of about 16 x 16 pixels.
Agreement compareEstimators(const std::vector<pt::Image>& a, const std::vector<pt::Image>& b);

}  // namespace bench
