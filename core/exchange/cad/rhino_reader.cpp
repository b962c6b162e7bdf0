// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/cad/rhino_reader.h"

#include <QString>
#include <bit>
#include <cmath>
#include <map>
#include <vector>

#include "core/base/conventions.h"
#include "core/exchange/cad/rhino_chunks.h"

namespace batten {
namespace rhino {
namespace {

tl::unexpected<Error> damaged(const char* what) {
  return fail(ErrorCode::BadParameter, std::string("The 3DM is damaged: ") + what + ". Export it again.");
}

/// Reads numbers off the front; stays at its end once there are too few bytes.
class Source {
 public:
  explicit Source(std::string_view bytes) : rest_(bytes) {}
  bool isWhole() const { return isWhole_; }
  std::string_view rest() const { return rest_; }
  std::string_view take(std::size_t count) {
    isWhole_ = isWhole_ && count <= rest_.size();
    const std::string_view taken = isWhole_ ? rest_.substr(0, count) : std::string_view{};
    rest_.remove_prefix(taken.size());
    return taken;
  }
  std::uint8_t byte() {
    const auto taken = take(1);
    return taken.empty() ? std::uint8_t{0} : static_cast<std::uint8_t>(taken[0]);
  }
  std::uint32_t number() {
    std::uint32_t value = 0;
    for (int shift = 0; shift < 32; shift += 8) value |= static_cast<std::uint32_t>(byte()) << shift;
    return value;
  }
  double real() {
    std::uint64_t bits = 0;
    for (int shift = 0; shift < 64; shift += 8) bits |= static_cast<std::uint64_t>(byte()) << shift;
    return std::bit_cast<double>(bits);
  }
  std::string words() {
    const std::uint32_t count = number();
    const auto taken = take(std::size_t{2} * count);
    QString text;
    for (std::size_t i = 0; i + 3 < taken.size(); i += 2)
      text += QChar(static_cast<uchar>(taken[i]), static_cast<uchar>(taken[i + 1]));
    return text.toStdString();
  }

 private:
  std::string_view rest_;
  bool isWhole_ = true;
};

struct Chunk {
  std::uint32_t code = 0, value = 0;
  std::string_view content;  ///< Without the CRC.
};

/// The chunks of a stretch of bytes in order; chunks of bare numbers must have the CRC that they state.
Result<std::vector<Chunk>> chunksOf(std::string_view bytes) {
  std::vector<Chunk> chunks;
  Source source(bytes);
  while (source.rest().size() >= 8) {
    Chunk chunk;
    chunk.code = source.number();
    chunk.value = source.number();
    if ((chunk.code & kShort) == 0) {
      chunk.content = source.take(chunk.value);
      if (!source.isWhole()) return damaged("a part reaches beyond its end");
      if ((chunk.code & kHasCrc) != 0 && chunk.code != kEndOfFile) {
        if (chunk.content.size() < 4) return damaged("a part is too short");
        Source stated(chunk.content.substr(chunk.content.size() - 4));
        chunk.content.remove_suffix(4);
        const std::uint32_t crc = stated.number();
        if (crc != 0 && crc != crc32(chunk.content) && chunk.code != kObjectAttributes)
          return damaged("a part has a wrong checksum");
      }
    }
    chunks.push_back(chunk);
  }
  return chunks;
}

/// The first chunk of a kind; null where there is none.
const Chunk* find(const std::vector<Chunk>& chunks, std::uint32_t code) {
  for (const Chunk& chunk : chunks)
    if (chunk.code == code) return &chunk;
  return nullptr;
}

/// Class and data of an object.
struct Instance {
  std::string_view id, data;
};
Result<Instance> instanceOf(const std::vector<Chunk>& chunks) {
  const Chunk* whole = find(chunks, kClass);
  if (whole == nullptr) return damaged("an object without a class");
  const auto parts = chunksOf(whole->content);
  if (!parts) return fail(parts.error());
  const Chunk *id = find(*parts, kClassId), *data = find(*parts, kClassData);
  if (id == nullptr || data == nullptr) return damaged("an object without data");
  return Instance{id->content, data->content};
}

Result<NurbsCurve> curveFrom(std::string_view data) {
  Source source(data);
  source.byte();
  const std::uint32_t dimension = source.number(), isRational = source.number(), order = source.number(),
                      count = source.number();
  source.take(8 + 6 * sizeof(double));
  const std::uint32_t knotCount = source.number();
  const bool isPossible = source.isWhole() && dimension == 3 && isRational <= 1 && order >= 2 && order <= 8 &&
                          count >= order && knotCount == count + order - 2 &&
                          knotCount <= source.rest().size() / sizeof(double);
  if (!isPossible) return damaged("a curve whose counts do not fit");
  std::vector<double> knots{0.0};
  for (std::uint32_t i = 0; i < knotCount; ++i) knots.push_back(source.real());
  knots.front() = knots[1];
  knots.push_back(knots.back());
  if (source.number() != count || source.rest().size() < count * (dimension + isRational) * sizeof(double))
    return damaged("a curve whose counts do not fit");
  std::vector<Vec2> points;
  std::vector<double> weights;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double x = source.real(), y = source.real();
    source.real();
    const double weight = isRational == 1 ? source.real() : 1.0;
    if (!(weight > 0.0) || !std::isfinite(weight)) return damaged("a weight that is none");
    points.emplace_back(x / weight, y / weight);
    if (isRational == 1) weights.push_back(weight);
  }
  return NurbsCurve::make(static_cast<int>(order) - 1, std::move(knots), std::move(points), std::move(weights));
}

Result<double> unitFrom(std::string_view settings) {
  const auto chunks = chunksOf(settings);
  if (!chunks) return fail(chunks.error());
  const Chunk* units = find(*chunks, kUnits);
  if (units == nullptr) return damaged("it states no unit");
  Source source(units->content);
  source.number();
  const std::uint32_t unit = source.number();
  if (unit == kInches) return kMillimetresPerInch;
  if (unit == kMillimetres) return 1.0;
  return fail(ErrorCode::BadParameter, "The 3DM is neither in mm nor in inches. Save it in one of them.");
}

Result<std::map<std::uint32_t, std::string>> layersFrom(std::string_view table) {
  std::map<std::uint32_t, std::string> names;
  const auto records = chunksOf(table);
  if (!records) return fail(records.error());
  for (const Chunk& record : *records) {
    if (record.code != kLayer) continue;
    const auto parts = chunksOf(record.content);
    if (!parts) return fail(parts.error());
    const auto layer = instanceOf(*parts);
    if (!layer) return fail(layer.error());
    Source source(layer->data);
    source.byte();
    source.number();
    const std::uint32_t index = source.number();
    source.take(4 * sizeof(std::uint32_t) + 4 + 2 * sizeof(double));
    names[index] = source.words();
    if (!source.isWhole()) return damaged("a layer ends too early");
  }
  return names;
}

/// Name and layer of an object.
struct Attributes {
  std::string name;
  std::uint32_t layer = 0;
};
Result<Attributes> attributesFrom(std::string_view content) {
  Attributes attributes;
  Source source(content);
  source.take(1 + 16);
  attributes.layer = source.number();
  source.take(4 * sizeof(std::uint32_t) - 4 + 2 * sizeof(double) + 2 * sizeof(std::uint32_t));
  attributes.name = source.words();
  if (!source.isWhole()) return damaged("the name of an object ends too early");
  return attributes;
}

Result<void> readObject(const Chunk& record, const std::map<std::uint32_t, std::string>& layers, CadDrawing& drawing) {
  const auto parts = chunksOf(record.content);
  if (!parts) return fail(parts.error());
  const auto object = instanceOf(*parts);
  if (!object) return fail(object.error());
  if (object->id != kNurbsCurveId) {
    ++drawing.left;
    return {};
  }
  auto curve = curveFrom(object->data);
  if (!curve) return fail(curve.error());
  Attributes attributes;
  if (const Chunk* stated = find(*parts, kObjectAttributes)) {
    auto read = attributesFrom(stated->content);
    if (!read) return fail(read.error());
    attributes = std::move(*read);
  }
  const auto layer = layers.find(attributes.layer);
  drawing.entities.push_back(
      {attributes.name, layer == layers.end() ? std::string() : layer->second, std::move(*curve)});
  return {};
}

}  // namespace
}  // namespace rhino

Result<CadDrawing> readRhino(std::string_view bytes) {
  using namespace rhino;
  if (!bytes.starts_with(kHead)) return damaged("it is not a 3DM of version 3");
  const auto tables = chunksOf(bytes.substr(kHead.size()));
  if (!tables) return fail(tables.error());
  const Chunk *settings = find(*tables, kSettings), *objects = find(*tables, kObjectTable),
              *layerTable = find(*tables, kLayerTable), *end = find(*tables, kEndOfFile);
  if (settings == nullptr || objects == nullptr || end == nullptr) return damaged("it ends too early");
  CadDrawing drawing;
  const auto unit = unitFrom(settings->content);
  if (!unit) return fail(unit.error());
  drawing.mmPerUnit = *unit;
  auto layers = layersFrom(layerTable == nullptr ? std::string_view{} : layerTable->content);
  if (!layers) return fail(layers.error());
  const auto records = chunksOf(objects->content);
  if (!records) return fail(records.error());
  for (const Chunk& record : *records) {
    if (record.code != kObject) continue;
    if (auto read = readObject(record, *layers, drawing); !read) return fail(read.error());
  }
  return drawing;
}

}  // namespace batten
