#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>

#include "loaders/mesh_file.h"

namespace pt {

/// Meshes asked for while a scene is parsed, and read afterwards: each file once, all in parallel.
class MeshLibrary {
 public:
  /// The mesh will be empty until load(). `source` is the place that asks, for messages.
  std::shared_ptr<const TriangleMesh> request(const MeshFile& file, const SourceLocation& source);

  /// Reads what was requested; for onMesh see LoadOptions. Throws InputError about the first request that cannot be
  /// satisfied.
  void load(const std::function<void(std::size_t read, std::size_t all)>& onMesh);

 private:
  struct Entry {
    std::shared_ptr<TriangleMesh> mesh;
    SourceLocation source;
  };
  std::map<MeshFile, Entry> m_entries;
};

}  // namespace pt
