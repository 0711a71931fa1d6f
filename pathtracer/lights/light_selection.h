#pragma once

#include <vector>

#include "lights/alias_table.h"
#include "lights/light.h"

namespace pt {

/// Chooses among lights in proportion to their power.
class LightSelection {
 public:
  LightSelection() = default;
  /// The lights outlive this.
  explicit LightSelection(std::vector<const Light*> lights);

  bool empty() const noexcept { return m_lights.empty(); }
  std::size_t size() const noexcept { return m_lights.size(); }

  struct Choice {
    const Light* light;
    float pmf;
    double remainder;  ///< in [0,1), uniform whatever the choice
  };
  /// u in [0,1). There is at least one light.
  Choice sample(double u) const noexcept {
    const auto pick = m_table.sample(u);
    return {m_lights[pick.index], m_pmf[pick.index], pick.remainder};
  }
  /// By position in the list given.
  float pmf(std::size_t index) const noexcept { return m_pmf[index]; }

 private:
  std::vector<const Light*> m_lights;
  std::vector<float> m_pmf;
  AliasTable m_table;
};

}  // namespace pt
