#include "loaders/mesh_library.h"

#include <mutex>

#include "core/parallel.h"
#include "loaders/loader_error.h"

namespace pt {

std::shared_ptr<const TriangleMesh> MeshLibrary::request(const MeshFile& file, const SourceLocation& source) {
  MeshFile key = file;
  std::error_code failed;
  if (const auto canonical = std::filesystem::canonical(file.path, failed); !failed) key.path = canonical;
  Entry& entry = m_entries[key];
  if (!entry.mesh) entry = {std::make_shared<TriangleMesh>(), source};
  return entry.mesh;
}

void MeshLibrary::load(const std::function<void(std::size_t read, std::size_t all)>& onMesh) {
  struct Job {
    const MeshFile* file;
    Entry* entry;
    std::string error;
  };
  std::vector<Job> jobs;
  for (auto& [file, entry] : m_entries) jobs.push_back({&file, &entry, {}});
  std::mutex telling;
  std::size_t read = 0;
  parallelFor(jobs.size(), [&](std::size_t i) {
    try {
      *jobs[i].entry->mesh = readMesh(*jobs[i].file);
    } catch (const InputError& error) {
      jobs[i].error = error.what();
    }
    if (!onMesh) return;
    const std::lock_guard lock(telling);
    onMesh(++read, jobs.size());
  });
  for (const Job& job : jobs)
    if (!job.error.empty()) failAt(job.entry->source, job.error);
}

}  // namespace pt
