#pragma once

#include "film/film.h"
#include "run/job.h"

namespace bench {

/// Renders a part of a reference, with a seed of its own. Throws pt::InputError or pt::WorkError.
pt::Image renderPart(const Plan& plan, const Job& job, const std::string& key);

/// A cell and its final picture.
struct RenderedCell {
  CellResult result;
  pt::Image image;
};

/// Renders a cell and measures it against the reference as it goes; the clock stands still while an error is measured.
/// Throws pt::InputError or pt::WorkError.
RenderedCell renderCell(const Plan& plan, const Job& job, const std::string& key, const pt::Image& reference);

}  // namespace bench
