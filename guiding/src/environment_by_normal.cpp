#include "guiding/environment_by_normal.h"

#include <algorithm>
#include <cmath>

#include "environment_grid.h"
#include "library_edge.h"
#include "sphere_map.h"

namespace guiding {

namespace {

constexpr int kBinsPerSide = 24;  // of the octahedral map of normals
constexpr int kBins = kBinsPerSide * kBinsPerSide;
constexpr int kNormalsPerSide = 2;       // of a bin, over which its masses are averaged
constexpr double kBinRadius = 0.1;       // no normal is further from one that stands for its bin; radians
constexpr double kSmallestMass = 1e-30;  // of a block that is not empty

std::vector<Imath::V3d> normalsOf(int bin) {
  std::vector<Imath::V3d> normals;
  for (int k = 0; k < kNormalsPerSide * kNormalsPerSide; ++k) {
    const auto along = [](int i, int part) {
      return (float(i) + (float(part) + 0.5f) / kNormalsPerSide) / kBinsPerSide;
    };
    normals.emplace_back(squareToSphere(DirectionMap::Octahedral, {along(bin % kBinsPerSide, k % kNormalsPerSide),
                                                                   along(bin / kBinsPerSide, k / kNormalsPerSide)}));
  }
  return normals;
}

/// Returns what they added up to.
double normalise(std::vector<double>& masses) {
  double total = 0;
  for (const double mass : masses) total += mass;
  for (double& mass : masses) mass /= std::max(total, kSmallestMass);
  return total;
}

/// Cuts an axis into at most `most` parts; writes the first patch of each and the end, and the part of each patch.
int split(int patches, int most, std::vector<int>& first, std::vector<std::uint8_t>& partOf) {
  const int count = std::min(patches, most);
  for (int i = 0; i <= count; ++i) first.push_back(int(std::int64_t(patches) * i / count));
  for (int i = 0; i < count; ++i) partOf.resize(std::size_t(first[std::size_t(i) + 1]), std::uint8_t(i));
  return count;
}

}  // namespace

/// Sums over directions, weighted.
struct EnvironmentProduct::Moments {
  double weight = 0;
  Imath::V3d mean{0, 0, 0};
  double xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;

  void add(const Imath::V3d& w, double by) {
    weight += by;
    mean += w * by;
    xx += w.x * w.x * by, yy += w.y * w.y * by, zz += w.z * w.z * by;
    xy += w.x * w.y * by, xz += w.x * w.z * by, yz += w.y * w.z * by;
  }

  /// Mean of max(0, n.w): n.w is taken as uniformly distributed about its mean with its variance, and wider by what a
  /// bin's normals differ, so that no bin is blind to light that one of its normals sees.
  double meanCosine(const Imath::V3d& n) const {
    const double second =
        xx * n.x * n.x + yy * n.y * n.y + zz * n.z * n.z + 2 * (xy * n.x * n.y + xz * n.x * n.z + yz * n.y * n.z);
    const double middle = mean.dot(n) / weight;
    const double half = std::sqrt(3 * std::max(0.0, second / weight - middle * middle)) + kBinRadius;
    const double above = std::clamp(middle + half, 0.0, 2 * half), beyond = std::max(0.0, middle - half);
    return above * above / (4 * half) + beyond;
  }
};

/// Directions of a block, weighted by light and by solid angle.
struct EnvironmentProduct::Block {
  Moments light, area;
  double mass = 0;  ///< of the table's density

  /// What a surface of normal n receives from the block, up to a factor.
  double received(const Imath::V3d& n) const {
    // Light of vertices on the border is counted with one of the neighbours: the mass is exact, its place is not.
    const Moments& place = light.weight > 0 ? light : area;
    return place.weight > 0 ? mass * place.meanCosine(n) : 0.0;
  }
};

Result<EnvironmentProduct> EnvironmentProduct::create(const EnvironmentTable& table) {
  return withoutThrowing([&]() -> Result<EnvironmentProduct> {
    if (table.empty()) return Error{ErrorCode::InvalidArgument, "an empty environment has no densities by normal"};
    EnvironmentProduct result(table);
    result.partition();
    result.fillBins();
    return result;
  });
}

void EnvironmentProduct::partition() {
  const bool octahedral = m_table->layout().mapping() == EnvironmentMapping::Octahedral;
  const EnvironmentTable::Patches all = m_table->allPatches();
  m_columns = split(all.x1, octahedral ? 24 : 32, m_firstX, m_columnOf);
  m_rows = split(all.y1, octahedral ? 24 : 16, m_firstY, m_rowOf);

  m_marginalSize = std::size_t(all.y1) + 1;
  m_marginal.resize(std::size_t(m_columns) * m_marginalSize);
  for (int i = 0; i < m_columns; ++i) {
    double* upTo = &m_marginal[std::size_t(i) * m_marginalSize];
    for (int y = 0; y < all.y1; ++y)
      upTo[y + 1] = upTo[y] + m_table->rowMass(y, m_firstX[std::size_t(i)], m_firstX[std::size_t(i) + 1]);
  }
  for (int row = 0; row < m_rows; ++row)
    for (int column = 0; column < m_columns; ++column) {
      const double* upTo = marginalOf(column);
      const double mass = upTo[m_firstY[std::size_t(row) + 1]] - upTo[m_firstY[std::size_t(row)]];
      m_inverseMass.push_back(mass > kSmallestMass ? float(1 / mass) : 0.0f);
    }
}

std::vector<EnvironmentProduct::Block> EnvironmentProduct::lookAtBlocks() const {
  const EnvironmentAxis columns = columnsOf(m_table->layout()), rows = rowsOf(m_table->layout());
  std::vector<Block> blocks(m_inverseMass.size());
  for (int y = 0; y < rows.vertices(); ++y)
    for (int x = 0; x < columns.vertices(); ++x) {
      const EnvironmentAxis::Point atX{std::min(x, columns.patches() - 1), x == columns.patches() ? 1.0f : 0.0f};
      const EnvironmentAxis::Point atY{std::min(y, rows.patches() - 1), y == rows.patches() ? 1.0f : 0.0f};
      const Imath::V3f w = m_table->layout().toDirection({columns.position(atX), rows.position(atY)});
      const double area = columns.widthAbout(x) * rows.widthAbout(y);
      const double areaPerSolidAngle = m_table->layout().locate(w).areaPerSolidAngle;  // 0 at the poles
      const double solidAngle = areaPerSolidAngle > 0 ? area / areaPerSolidAngle : 0;
      Block& block = blocks[blockOf(atX.patch, atY.patch)];
      block.light.add(Imath::V3d(w), m_table->m_density[std::size_t(y) * m_table->m_columns + std::size_t(x)] * area);
      block.area.add(Imath::V3d(w), solidAngle);
    }
  for (std::size_t i = 0; i < blocks.size(); ++i) blocks[i].mass = m_inverseMass[i] > 0 ? 1 / m_inverseMass[i] : 0;
  return blocks;
}

void EnvironmentProduct::fillBins() {
  const std::vector<Block> blocks = lookAtBlocks();
  m_binSize = std::size_t(m_rows + 1) + std::size_t(m_rows) * std::size_t(m_columns + 1);
  m_masses.assign(kBins * m_binSize, 0.0f);
  m_meanCosine.assign(kBins, 0.0f);
  std::vector<double> masses(blocks.size());
  for (int bin = 0; bin < kBins; ++bin) {
    std::fill(masses.begin(), masses.end(), 0.0);
    for (const Imath::V3d& n : normalsOf(bin))
      for (std::size_t i = 0; i < blocks.size(); ++i) masses[i] += blocks[i].received(n);
    m_meanCosine[std::size_t(bin)] = float(normalise(masses) / (kNormalsPerSide * kNormalsPerSide));
    storeBin(bin, masses);
  }
}

void EnvironmentProduct::storeBin(int bin, const std::vector<double>& masses) {
  float* rows = &m_masses[std::size_t(bin) * m_binSize];
  for (int row = 0; row < m_rows; ++row) {
    float* upTo = rows + (m_rows + 1) + row * (m_columns + 1);
    for (int column = 0; column < m_columns; ++column)
      upTo[column + 1] = upTo[column] + float(masses[std::size_t(row * m_columns + column)]);
    rows[row + 1] = rows[row] + upTo[m_columns];
  }
}

std::uint32_t EnvironmentProduct::bin(const Imath::V3f& normal) const noexcept {
  const Imath::V2f uv = sphereToSquare(DirectionMap::Octahedral, normal);
  const auto cell = [](float x) { return std::uint32_t(std::clamp(int(x * kBinsPerSide), 0, kBinsPerSide - 1)); };
  return cell(uv.y) * kBinsPerSide + cell(uv.x);
}

Imath::V3f EnvironmentProduct::draw(std::uint32_t bin, const Imath::V2f& u) const noexcept {
  const auto choose = [](const float* upTo, int count, float& at) {
    const float whole = upTo[count];
    const float x = std::min(at * whole, std::nextafter(whole, 0.0f));
    const int i = int(std::upper_bound(upTo + 1, upTo + count, x) - (upTo + 1));
    at = std::clamp((x - upTo[i]) / (upTo[i + 1] - upTo[i]), 0.0f, kOneMinusEpsilon);
    return i;
  };
  const float* rows = massesOf(bin);
  if (!(rows[m_rows] > 0)) return {0, 0, 1};
  Imath::V2f rest = u;
  const int row = choose(rows, m_rows, rest.y);
  const int column = choose(blocksOf(bin, row), m_columns, rest.x);
  const EnvironmentTable::Patches block{m_firstX[std::size_t(column)], m_firstX[std::size_t(column) + 1],
                                        m_firstY[std::size_t(row)], m_firstY[std::size_t(row) + 1]};
  return m_table->draw(block, marginalOf(column), rest);
}

float EnvironmentProduct::pdf(std::uint32_t bin, const EnvironmentPoint& point) const noexcept {
  const int x = columnsOf(m_table->layout()).locate(point.uv.x).patch;
  const int y = rowsOf(m_table->layout()).locate(point.uv.y).patch;
  const int column = m_columnOf[std::size_t(x)], row = m_rowOf[std::size_t(y)];
  const float* upTo = blocksOf(bin, row);
  return m_table->pdf(point) * ((upTo[column + 1] - upTo[column]) * m_inverseMass[blockOf(x, y)]);
}

std::size_t EnvironmentProduct::memoryBytes() const noexcept {
  return m_masses.capacity() * sizeof(float) + m_marginal.capacity() * sizeof(double);
}

Result<std::unique_ptr<const EnvironmentByNormal::Level>> EnvironmentByNormal::makeLevel(const EnvironmentImage& image,
                                                                                         float lightShare) {
  auto table = EnvironmentTable::create(image, {EnvironmentCompensation::SubtractMean, lightShare});
  if (!table) return table.error();
  if (table.value().empty()) return std::unique_ptr<const Level>();
  auto product = EnvironmentProduct::create(table.value());
  if (!product) return product.error();
  auto level = std::make_unique<Level>(Level{std::move(table).value(), std::move(product).value()});
  level->product.moveTo(level->table);
  return std::unique_ptr<const Level>(std::move(level));
}

Result<EnvironmentByNormal> EnvironmentByNormal::create(const EnvironmentImage& image, const EnvironmentTable& complete,
                                                        float lightShare) {
  return withoutThrowing([&]() -> Result<EnvironmentByNormal> {
    EnvironmentByNormal result;
    auto less = makeLevel(image, (1 + lightShare) / 2), more = makeLevel(image, lightShare);
    if (!less) return less.error();
    if (!more) return more.error();
    result.m_less = std::move(less).value();
    result.m_more = std::move(more).value();
    if (!result.m_less) return result;
    const auto irradiance = EnvironmentProduct::create(complete);
    if (!irradiance) return irradiance.error();
    for (std::uint32_t bin = 0; bin < kBins; ++bin) {
      // E/pi by the mean; the amounts stand for 1 and 2.
      const bool isNearer = 4 * irradiance.value().meanCosine(bin) > std::sqrt(2.0f);
      result.m_takesMore.push_back(result.m_more && isNearer);
    }
    return result;
  });
}

std::size_t EnvironmentByNormal::memoryBytes() const noexcept {
  std::size_t bytes = 0;
  for (const Level* level : {m_less.get(), m_more.get()})
    if (level) bytes += level->table.memoryBytes() + level->product.memoryBytes();
  return bytes;
}

}  // namespace guiding
