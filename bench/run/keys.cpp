#include "run/keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <fstream>

#include "core/error.h"
#include "core/hash.h"
#include "integrators/settings_json.h"

namespace bench {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostFiles = 10000;
constexpr int kFormatVersion = 1;  // raised when cells or references come to mean something else

class Hasher {
 public:
  void add(std::string_view bytes) {
    std::size_t i = 0;
    for (; i + 8 <= bytes.size(); i += 8) {
      std::uint64_t word;
      std::memcpy(&word, bytes.data() + i, 8);
      addWord(word);
    }
    for (; i < bytes.size(); ++i) addWord(static_cast<unsigned char>(bytes[i]));
    addWord(bytes.size());
  }
  std::uint64_t value() const { return m_hash; }

 private:
  void addWord(std::uint64_t word) { m_hash = pt::combineHash(m_hash, word); }
  std::uint64_t m_hash = 0;
};

std::uint64_t hashOf(std::string_view text) {
  Hasher hasher;
  hasher.add(text);
  return hasher.value();
}

std::string keyOf(const Json& json) {
  return fmt::format("{:016x}", hashOf(json.dump()));
}

std::vector<fs::path> filesOf(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    files.push_back(entry.path());
    if (files.size() > kMostFiles)
      throw pt::InputError(fmt::format("{}: holds more than {} files; put the scene into a folder of its own",
                                       folder.string(), kMostFiles));
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// What a picture of the scene depends on besides the estimator.
Json sceneJson(const ScenePlan& scene, const std::string& sceneHash) {
  return {{"version", kFormatVersion},
          {"scene", sceneHash},
          {"file", scene.file.filename().string()},
          {"variables", scene.load.variables},
          {"skipUnsupported", scene.load.skipUnsupported},
          {"width", scene.width},
          {"height", scene.height},
          {"maxDepth", scene.maxDepth ? Json(*scene.maxDepth) : Json()}};
}

void addContent(Hasher& hasher, const fs::path& file) {
  std::string bytes(1 << 20, '\0');
  std::ifstream stream(file, std::ios::binary);
  while (stream) {
    stream.read(bytes.data(), std::streamsize(bytes.size()));
    hasher.add(std::string_view(bytes.data(), std::size_t(stream.gcount())));
  }
}

}  // namespace

std::string hashScene(const ScenePlan& scene) {
  if (!fs::is_regular_file(scene.file))
    throw pt::InputError(fmt::format("{}: no such scene file", scene.file.string()));
  const fs::path folder = scene.file.parent_path();
  Hasher hasher;
  for (const fs::path& file : filesOf(folder)) {
    hasher.add(fs::relative(file, folder).generic_string());
    addContent(hasher, file);
  }
  if (!scene.environmentMap.empty()) {
    if (!fs::is_regular_file(scene.environmentMap))
      throw pt::InputError(fmt::format("{}: no such environment map", scene.environmentMap.string()));
    addContent(hasher, scene.environmentMap);
  }
  return fmt::format("{:016x}", hasher.value());
}

std::string referenceKey(const ScenePlan& scene, const ReferenceEstimator& estimator, const std::string& sceneHash) {
  Json json = sceneJson(scene, sceneHash);
  json["estimator"] = estimator.variant.source;
  json["estimator"].erase("parts");
  return keyOf(json);
}

std::string cellKey(const Plan& plan, const Job& job, const std::string& sceneHash) {
  Json json = sceneJson(*job.scene, sceneHash);
  const ReferenceEstimator& reference = job.scene->reference.main;
  json["reference"] = {referenceKey(*job.scene, reference, sceneHash), reference.parts};
  json["variant"] = job.variant->source;
  if (job.variant->guiding) json["variant"]["guiding"] = pt::toJson(*job.variant->guiding);  // presets may change
  if (job.variant->direct) json["variant"]["direct"] = pt::toJson(*job.variant->direct);
  json["variant"].erase("note");
  const Budget& budget = plan.budgetOf(*job.scene);
  json["budget"] = {budget.seconds, budget.spp};
  json["curvePoints"] = plan.curvePoints;
  json["threads"] = plan.threads;
  json["seed"] = job.index;
  return keyOf(json);
}

std::uint64_t seedOfPart(const std::string& key, int part) {
  return pt::combineHash(hashOf(key), std::uint64_t(part));
}

std::uint64_t seedOfCell(const CellId& id) {
  return pt::combineHash(pt::combineHash(hashOf(id.scene), hashOf(id.variant)), std::uint64_t(id.seed));
}

}  // namespace bench
