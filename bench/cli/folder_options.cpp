#include "cli/folder_options.h"

#include <fmt/format.h>

#include "core/replace_file.h"
#include "report/html_report.h"
#include "results/collect.h"
#include "results/write_results.h"

namespace bench {

void addOptions(CLI::App& command, FolderOptions& options) {
  command.add_option("plan", options.plan, "Plan (JSON): scenes, variants, seeds, budget")
      ->required()
      ->type_name("PLAN.json");
  command.add_option("-o,--out", options.out, "Folder for results; an interrupted run goes on there")
      ->required()
      ->type_name("DIR");
  command
      .add_option("--references", options.references, "Folder that keeps reference pictures (default: DIR/references)")
      ->type_name("DIR");
}

void writeReports(const Plan& plan, const RunFolder& folder) {
  const Results results = collectResults(plan, folder);
  const Json json = resultsToJson(plan, results);
  pt::replaceFile(folder.root / "results.json", json.dump(1) + "\n");
  pt::replaceFile(folder.root / "results.csv", resultsToCsv(results));
  pt::replaceFile(folder.root / "report.html", htmlReport(plan, folder, json));
  for (const char* name : {"report.html", "results.json", "results.csv"})
    fmt::print("{}\n", (folder.root / name).string());
}

}  // namespace bench
