// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/cad/iges_reader.h"

#include <Eigen/LU>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "core/base/conventions.h"
#include "core/exchange/cad/iges_records.h"
#include "core/exchange/cad/iges_shapes.h"

namespace batten {
namespace {

struct IgesMatrix {
  Eigen::Matrix2d linear = Eigen::Matrix2d::Identity();
  Vec2 offset = Vec2::Zero();
  bool isIdentity() const { return linear == Eigen::Matrix2d::Identity() && offset == Vec2::Zero(); }
};

std::optional<double> millimetresOf(int flag, const std::string& name) {
  static const std::map<int, double> kUnits = {{1, kMillimetresPerInch},
                                               {2, 1.0},
                                               {4, 12.0 * kMillimetresPerInch},
                                               {5, 1609344.0},
                                               {6, 1000.0},
                                               {7, 1e6},
                                               {8, 1e-3 * kMillimetresPerInch},
                                               {9, 1e-3},
                                               {10, 10.0},
                                               {11, 1e-6 * kMillimetresPerInch}};
  static const std::map<std::string, double> kNames = {{"MM", 1.0},
                                                       {"IN", kMillimetresPerInch},
                                                       {"INCH", kMillimetresPerInch},
                                                       {"CM", 10.0},
                                                       {"M", 1000.0},
                                                       {"FT", 12.0 * kMillimetresPerInch},
                                                       {"UM", 1e-3}};
  constexpr int kByName = 3;  // flag: the unit is the name, not the number
  if (flag == kByName) {
    const auto named = kNames.find(name);
    return named == kNames.end() ? std::nullopt : std::optional(named->second);
  }
  const auto known = kUnits.find(flag);
  return known == kUnits.end() ? std::nullopt : std::optional(known->second);
}

class IgesReader {
 public:
  IgesReader(IgesRecords records, const RunContext& context) : records_(std::move(records)), context_(context) {
    // Each line belongs to one entry; matrices are read once.
    constexpr std::size_t kLineBytes = 64, kOfAll = 4;
    charactersLeft_ = kOfAll * kLineBytes * records_.data.size() + kLineBytes;
  }

  Result<CadDrawing> read() {
    readUnit();
    if (auto done = findComposites(); !done) return fail(done.error());
    for (std::size_t i = 0; i < records_.entries.size(); ++i) {
      constexpr std::size_t kEvery = 256;  // between two looks at whether the run was cancelled
      if (i % kEvery == 0 && context_.isCancelled()) return cancelled();
      if (records_.entries[i].type == kComposite) {
        for (const std::size_t child : children_[i]) {
          if (auto done = take(child); !done) return fail(done.error());
        }
      } else if (!isChild_.contains(i)) {
        if (auto done = take(i); !done) return fail(done.error());
      }
    }
    return std::move(drawing_);
  }

 private:
  static constexpr int kComposite = 102, kMatrix = 124;  // types of entities

  void readUnit() {
    // The third parameter of the section is the first here: the unit's flag is the 14th, its name the 15th.
    constexpr std::size_t kFlag = 14 - 3, kName = 15 - 3;
    const auto& global = records_.global;
    const auto flag = global.size() > kFlag ? igesNumber(global[kFlag]) : std::nullopt;
    const std::string name = global.size() > kName ? global[kName] : std::string();
    if (flag && *flag >= 0.0 && *flag < 100.0) drawing_.mmPerUnit = millimetresOf(static_cast<int>(*flag), name);
  }

  std::optional<std::size_t> entryAt(double directoryLine) const {
    const double index = (std::abs(directoryLine) - 1.0) / 2.0;
    if (!(index >= 0.0) || index != std::floor(index) || index >= static_cast<double>(records_.entries.size()))
      return std::nullopt;
    return static_cast<int>(index);
  }

  Result<void> findComposites() {
    for (std::size_t i = 0; i < records_.entries.size(); ++i) {
      if (records_.entries[i].type != kComposite) continue;
      const auto fields = parametersOf(records_, records_.entries[i], charactersLeft_);
      if (!fields) return fail(fields.error());
      const IgesNumbers n(*fields);
      const auto count = n.count(0, 0, kMostIgesPoints);
      if (!count || !n.has(1 + *count))
        return igesDamaged(records_.entries[i].line, "a composite curve does not name its parts");
      for (int k = 0; k < *count; ++k) {
        const auto child = entryAt(n.at(1 + k));
        if (!child) return igesDamaged(records_.entries[i].line, "a part of a composite curve is missing");
        // A part of two composites counts once, a composite within another by itself.
        if (records_.entries[*child].type == kComposite || !isChild_.insert(*child).second) continue;
        children_[i].push_back(*child);
      }
    }
    return {};
  }

  /// The matrices of an entry, the inner one first.
  Result<IgesMatrix> matrixOf(const IgesDirectoryEntry& entry) {
    constexpr int kDeepest = 8;  // matrices on matrices: a circle of them ends
    IgesMatrix all;
    std::optional<int> line = entry.matrix;
    for (int depth = 0; line; ++depth) {
      const auto at = entryAt(*line);
      if (!at || depth == kDeepest || records_.entries[*at].type != kMatrix)
        return igesDamaged(entry.line, "its transformation is missing");
      auto known = matrices_.find(*at);
      if (known == matrices_.end()) {
        const auto fields = parametersOf(records_, records_.entries[*at], charactersLeft_);
        if (!fields) return fail(fields.error());
        const IgesNumbers n(*fields);
        if (!n.has(12)) return igesDamaged(records_.entries[*at].line, "a transformation has too few numbers");
        IgesMatrix one;
        one.linear << n.at(0), n.at(1), n.at(4), n.at(5);
        one.offset = {n.at(3), n.at(7)};
        known = matrices_.emplace(*at, one).first;
      }
      all.offset = known->second.linear * all.offset + known->second.offset;
      all.linear = known->second.linear * all.linear;
      line = records_.entries[*at].matrix;
    }
    return all;
  }

  /// The records of the properties of an entry.
  std::vector<std::size_t> propertiesOf(const IgesDirectoryEntry& entry, const std::vector<std::string>& fields) const {
    constexpr int kProperty = 406, kMostProperties = 64;  // a type; limit of input
    std::vector<std::size_t> found;
    const IgesNumbers n(fields);
    const auto own = igesOwnNumbers(entry, n);
    const auto groups = own ? n.count(*own, 0, kMostProperties) : std::nullopt;
    if (!groups) return found;
    const std::size_t at = *own + 1 + *groups;
    const auto properties = n.count(at, 0, kMostProperties);
    for (int i = 0; properties && i < *properties && n.has(at + 2 + i); ++i) {
      const auto property = entryAt(n.at(at + 1 + i));
      if (property && records_.entries[*property].type == kProperty) found.push_back(*property);
    }
    return found;
  }

  /// The text that a property holds behind its type and the numbers before it; empty where it is damaged, which is no
  /// reason to refuse the curve. Several curves may share a property.
  const std::string& textOf(std::size_t property, std::size_t field) {
    const auto [known, isNew] = texts_.try_emplace(property);
    if (!isNew) return known->second;
    const auto values = parametersOf(records_, records_.entries[property], charactersLeft_);
    if (values && values->size() > field) known->second = (*values)[field];
    return known->second;
  }

  /// The name of an entry: its name property, which holds more than the eight letters of a label.
  std::string nameOf(const IgesDirectoryEntry& entry, const std::vector<std::size_t>& properties) {
    constexpr int kNameForm = 15;     // of a property
    constexpr std::size_t kName = 2;  // behind its type and the count of its values
    for (const std::size_t property : properties) {
      if (records_.entries[property].form != kNameForm) continue;
      if (const std::string& name = textOf(property, kName); !name.empty()) return name;
    }
    return entry.label;
  }

  /// The layer of an entry: what its level is for, by a level function property, else the number of the level.
  std::string layerOfEntry(const IgesDirectoryEntry& entry, const std::vector<std::size_t>& properties) {
    constexpr int kLevelForm = 3;            // of a property
    constexpr std::size_t kDescription = 3;  // behind its type, the count of its values and a code
    if (entry.level <= 0) return {};
    for (const std::size_t property : properties) {
      if (records_.entries[property].form != kLevelForm) continue;
      if (const std::string& name = textOf(property, kDescription); !name.empty()) return name;
    }
    return "Level " + std::to_string(entry.level);
  }

  /// Texts, views, colours and the like are no curves and not missed.
  static bool isOther(int type) {
    return type == 0 || type == 116 || type == kMatrix || (type >= 200 && type < 300) || type >= 302;
  }

  Result<void> take(std::size_t index) {
    const IgesDirectoryEntry& entry = records_.entries[index];
    // places and values of the digits of the status
    constexpr int kBlanked = 1000000, kUse = 100, kParameterSpace = 5;
    const bool isHidden = entry.status / kBlanked == 1 || entry.status / kUse % 100 == kParameterSpace;
    if (isOther(entry.type) || isHidden) return {};
    static const std::set<int> kCurves = {100, 104, 106, 110, 112, 126};
    if (!kCurves.contains(entry.type)) {
      ++drawing_.left;
      return {};
    }
    const auto fields = parametersOf(records_, entry, charactersLeft_);
    if (!fields) return fail(fields.error());
    auto shape = igesShape(entry, IgesNumbers(*fields));
    auto matrix = matrixOf(entry);
    if (!matrix) return fail(matrix.error());
    if (shape && !matrix->isIdentity()) {
      const auto curve = curveOf(*shape);
      shape = curve && std::abs(matrix->linear.determinant()) > 0.0
                  ? std::optional<CadShape>(curve->mapped(matrix->linear, matrix->offset))
                  : std::nullopt;
    }
    if (!shape) {
      ++drawing_.left;
      return {};
    }
    const std::vector<std::size_t> properties = propertiesOf(entry, *fields);
    drawing_.entities.push_back({nameOf(entry, properties), layerOfEntry(entry, properties), std::move(*shape)});
    return {};
  }

  IgesRecords records_;
  const RunContext& context_;
  std::size_t charactersLeft_ =
      0;  ///< Characters that may still be read: a damaged file may name one line a million times.
  std::map<std::size_t, std::vector<std::size_t>> children_;
  std::set<std::size_t> isChild_;
  std::map<std::size_t, IgesMatrix> matrices_;
  std::map<std::size_t, std::string> texts_;  ///< Of properties, by their records.
  CadDrawing drawing_;
};

}  // namespace

Result<CadDrawing> parseIges(std::string_view text, const RunContext& context) {
  auto records = readIgesRecords(text);
  if (!records) return fail(records.error());
  return IgesReader(std::move(*records), context).read();
}

}  // namespace batten
