// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/image/colour/inks.h"
#include "core/image/colour/paper_colour.h"

namespace batten {

/// [0..1] Darkness in the darkest channel, by which a pixel is surely ink: for the list of inks, and for black beside
/// colour.
inline constexpr float kSureDarkness = 0.2f;

enum class InkKind { Paper, Neutral, Hued };

/// What a pixel shows of an ink.
struct InkLook {
  InkKind kind = InkKind::Paper;
  float hueDeg = 0.0f;    ///< [deg] 0..360; of Hued alone.
  float darkness = 0.0f;  ///< 0..1
  InkColour colour() const {
    return {kind == InkKind::Hued ? std::optional(static_cast<double>(hueDeg)) : std::nullopt};
  }
};

/// Reads the looks of a row of a colour picture, against its paper.
class LookReader {
 public:
  LookReader(const PaperColour& paper, int width, int height) : paper_(paper), width_(width), height_(height) {}
  /// Goes to row y; to be called before at().
  void setRow(int y);
  InkLook at(int x, const Rgb8&) const;

 private:
  const PaperColour& paper_;
  int width_, height_, y_ = 0;
  std::array<std::vector<float>, 3> ratios_;
};

}  // namespace batten
