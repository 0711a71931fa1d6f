#include "run/work.h"

#include "core/replace_file.h"
#include "film/image_io.h"
#include "reference/reference.h"
#include "run/keys.h"
#include "run/render_job.h"

namespace bench {

void work(const Plan& plan, const RunFolder& folder, const Job& job) {
  const ReferenceStore store(folder.references);
  const std::string sceneHash = hashScene(*job.scene);
  const std::string key = referenceKey(*job.scene, job.estimator(), sceneHash);
  if (!job.isCell()) return store.savePart(key, job.index, renderPart(plan, job, key));

  const ReferenceEstimator& main = job.scene->reference.main;
  const pt::Image reference = combineParts(store.loadParts(key, main.parts), main.sppPerPart).image;
  const RenderedCell cell = renderCell(plan, job, cellKey(plan, job, sceneHash), reference);
  if (job.index == 0) {
    const std::filesystem::path picture = folder.picture(job.scene->name, job.variant->name);
    std::filesystem::create_directories(picture.parent_path());
    pt::writeExr(picture, cell.image);
  }
  pt::replaceFile(folder.cell(cell.result.id), toJson(cell.result).dump(1) + "\n");
}

}  // namespace bench
