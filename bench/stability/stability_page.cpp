#include <fmt/format.h>

#include "report/report_assets.h"
#include "stability/stability_report.h"

namespace bench {

namespace {

using Json = nlohmann::ordered_json;

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '<')
      safe += "&lt;";
    else if (c == '>')
      safe += "&gt;";
    else if (c == '&')
      safe += "&amp;";
    else
      safe += c;
  }
  return safe;
}

std::string number(const Json& row, const char* key, const char* format = "{:.3g}") {
  const auto found = row.find(key);
  if (found == row.end() || found->is_null()) return "–";
  return fmt::format(fmt::runtime(format), found->get<double>());
}

std::string ratioCell(const Json& row) {
  if (!row.contains("errorRatio") || row.at("variant") == "unguided") return "<td class=\"number\">–</td>";
  const Json& interval = row.at("errorRatioInterval");
  if (interval[0].is_null() || interval[1].is_null())
    return fmt::format("<td class=\"number\">{}</td>", number(row, "errorRatio"));
  const double low = interval[0], high = interval[1];
  return fmt::format("<td class=\"number {}\">{}<span class=\"interval\">{:.3g} to {:.3g}</span></td>",
                     high < 1  ? "better"
                     : low > 1 ? "worse"
                               : "",
                     number(row, "errorRatio"), low, high);
}

std::string tableRow(const Json& row) {
  std::string faults;
  for (const Json& fault : row.at("faults")) faults += "<br>" + escaped(fault.get<std::string>());
  const bool rendered = row.contains("finite");
  return fmt::format(
      "<tr><td>{}</td><td>{}</td><td class=\"number\">{}</td><td class=\"number\">{}</td><td class=\"number\">{}</td>"
      "<td class=\"number\">{}</td><td class=\"number\">{}</td>{}<td class=\"number\">{}</td>"
      "<td class=\"number\">{:.0f}</td><td>{}</td><td{}>{}{}</td></tr>\n",
      escaped(row.at("variant")),
      !rendered                      ? "–"
      : row.at("finite").get<bool>() ? "yes"
                                     : "no",
      rendered ? row.at("rejectedSamples").dump() : "–", row.at("droppedRecords").dump(), number(row, "z", "{:.2f}"),
      number(row, "largestOverMean"), number(row, "relativeError"), ratioCell(row),
      row.at("variant") == "unguided" ? "–" : number(row, "timeRatio", "{:.2f}"),
      row.at("memoryBytes").get<double>() / 1000, escaped(row.at("figures")),
      row.at("passed").get<bool>() ? "" : " class=\"warning\"", row.at("passed").get<bool>() ? "passed" : "failed",
      faults);
}

constexpr const char* kHeading =
    "<tr><th>variant</th><th>finite</th><th class=\"number\">samples rejected</th><th class=\"number\">records "
    "dropped</th><th class=\"number\">bias z</th><th class=\"number\">largest sample / mean</th><th "
    "class=\"number\">relative "
    "error</th><th class=\"number\">error / unguided</th><th class=\"number\">time / unguided</th><th class=\"number\">"
    "memory kB</th><th>figures</th><th></th></tr>\n";

std::string section(const Json& description) {
  std::string rows;
  for (const Json& row : description.at("rows")) rows += tableRow(row);
  const std::string loss = description.at("knownLoss"), tail = description.at("heavyTail");
  return fmt::format("<h3>{}</h3>\n<p>{}</p>\n{}{}<div class=\"scroll\"><table>\n{}{}</table></div>\n",
                     escaped(description.at("name")), escaped(description.at("expectation")),
                     loss.empty() ? "" : "<p class=\"dim\">Known loss: " + escaped(loss) + "</p>\n",
                     tail.empty() ? "" : "<p class=\"dim\">Bias not judged: " + escaped(tail) + "</p>\n", kHeading,
                     rows);
}

}  // namespace

std::string stabilityPage(const nlohmann::ordered_json& json) {
  std::string body;
  for (const Json& description : json.at("cases")) body += section(description);
  const int faulty = json.at("faultyRows");
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>guiding-bench stability</title>\n"
      "<style>{}</style></head>\n<body><main><h1>Stability</h1>\n"
      "<p class=\"{}\">{} cases, {} faulty rows; |z| of an unbiased suite stays below {:.2f} with a chance of 99%; an "
      "error above {} times the unguided one at equal samples is a fault unless a reason is given. {:.0f} s, {}.</p>\n"
      "{}</main></body></html>\n",
      kReportStyle, faulty == 0 ? "dim" : "warning", json.at("cases").size(), faulty, json.at("zBound").get<double>(),
      json.at("errorLimit").get<double>(), json.at("seconds").get<double>(),
      escaped(json.at("machine").at("processor")), body);
}

}  // namespace bench
