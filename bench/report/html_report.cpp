#include "report/html_report.h"

#include <fmt/format.h>

#include "core/error.h"
#include "report/report_assets.h"
#include "report/report_pictures.h"

namespace bench {

namespace {

/// Replaces the one place where `marker` stands.
void insert(std::string& page, const std::string& marker, const std::string& text) {
  page.replace(page.find(marker), marker.size(), text);
}

/// JSON that cannot end the script element that holds it: "</" becomes "<\\/", which means the same.
std::string embeddable(const Json& json) {
  const std::string text = json.dump();
  std::string safe;
  safe.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '/' && i > 0 && text[i - 1] == '<') safe += '\\';
    safe += text[i];
  }
  return safe;
}

std::vector<std::string> pictureNames(const Json& scene) {
  std::vector<std::string> names;
  for (const Json& variant : scene.at("variants")) names.push_back(variant.at("name"));
  for (const Json& import : scene.at("imports")) names.push_back(import.at("name"));
  return names;
}

}  // namespace

std::string htmlReport(const Plan& plan, const RunFolder& folder, const Json& results) {
  Json data = results;
  data["pictures"] = Json::object();
  for (std::size_t i = 0; i < plan.scenes.size(); ++i) {
    const Json& scene = results.at("scenes").at(i);
    if (scene.at("failure").get<std::string>().empty())
      data["pictures"][plan.scenes[i].name] = picturesOf(plan.scenes[i], pictureNames(scene), folder);
  }
  std::string page = kReportHtml;
  insert(page, "{{title}}", fmt::format("guiding-bench: {}", plan.name));
  insert(page, "{{style}}", kReportStyle);
  insert(page, "{{script}}", kReportScript);
  insert(page, "{{data}}", embeddable(data));
  return page;
}

}  // namespace bench
