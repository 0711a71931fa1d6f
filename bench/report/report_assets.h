#pragma once

namespace bench {

/// The page's parts, from report.html, report.css and report.js.
extern const char kReportHtml[], kReportStyle[], kReportScript[];

}  // namespace bench
