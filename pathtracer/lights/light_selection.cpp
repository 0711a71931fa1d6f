#include "lights/light_selection.h"

#include <algorithm>

namespace pt {

LightSelection::LightSelection(std::vector<const Light*> lights) : m_lights(std::move(lights)) {
  if (m_lights.empty()) return;
  std::vector<double> powers;
  for (const Light* light : m_lights) powers.push_back(light->power());
  const double largest = *std::max_element(powers.begin(), powers.end());
  double sum = 0;
  for (double power : powers) sum += power / largest;
  for (double power : powers) m_pmf.push_back(float(power / largest / sum));
  m_table = AliasTable(powers);
}

}  // namespace pt
