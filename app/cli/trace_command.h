// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/cancel_token.h"

namespace batten::cli {

/// The words of `batten-cli trace`, as typed.
struct TraceArguments {
  std::string scan;                        ///< Empty: the recipe's own empty page
  std::vector<std::string> outputs;        ///< -o: the ending chooses the format
  std::string preset;                      ///< --preset
  std::string unit;                        ///< --unit mm|in
  std::optional<std::string> scale;        ///< --scale
  std::optional<std::string> tolerance;    ///< --tolerance [mm]
  std::string paper;                       ///< --paper a4|letter; empty: a4
  std::optional<std::string> curves;       ///< --curves 1,3-5; empty: all
  std::string which;                       ///< --which faired|sketched|both; empty: faired
  bool joined = false;                     ///< --joined
  bool apart = false;                      ///< --apart
  bool splinesOnly = false;                ///< --splines-only
  bool widthOutline = false;               ///< --width-outline
  std::string flavour;                     ///< --flavour exact|bezier|cubic; empty: the preset's, else exact
  bool chords = false;                     ///< --chords
  std::string recipe;                      ///< --recipe
  std::string asIn;                        ///< --as-in PAPER, before the settings
  std::vector<std::string> settings;       ///< --set stage.parameter=value
  std::vector<std::string> corners;        ///< --corner X,Y[,MM|,rMM][,g1|,g2|,g3]
  std::vector<std::string> segmentPoints;  ///< --segment-point X,Y
  std::vector<std::string> outlines;       ///< --outline X,Y
  std::vector<std::string> centrelines;    ///< --centreline X,Y
  std::vector<std::string> pairings;       ///< --pair X,Y[,X,Y,X,Y…]
  std::vector<std::string> regions;        ///< --roi X,Y,WIDTH,HEIGHT
  std::optional<std::string> dpi;          ///< --dpi
  std::vector<std::string> imports;        ///< --import FILE; a scan that is a file of curves counts as one
  std::string importUnit;                  ///< --import-unit mm|cm|m|in
  bool isOneOfAll = false;                 ///< One of the pages of --page all
  std::optional<std::string> page;         ///< --page N|all; absent: the recipe's, else the first
  bool takesAllPages = true;               ///< Whether --page all is known to the command
  std::optional<std::string> knownLength;  ///< --known-length X,Y,X,Y,LENGTH
  std::vector<std::string> directions;     ///< --direction X,Y,X,Y
  std::vector<std::string> starts;         ///< --start X,Y
  std::string report;                      ///< --report
  bool reportTargets = false;              ///< --report-targets
  bool reportSeries = false;               ///< --report-series
  bool explain = false;                    ///< --explain
  std::vector<std::string> dumps;          ///< --dump STAGE=FILE.png
  std::string saveRecipe;                  ///< --save-recipe
  std::optional<std::string> threads;      ///< --threads
};

/// The process in which a trace is made.
struct TraceHost {
  CancelToken cancel;
  bool isShared = false;  ///< It traces other drawings, too: its peak of memory is not that of this one.
};

/// Traces a scan and writes what was asked for; one line of JSON on stdout when done. Returns the exit code. Of all
/// pages of a file there is a line for each; that of a failing page says why, as does stderr, and it does not stop the
/// others. The exit code is that of the first one that failed.
int runTrace(const TraceArguments&, const TraceHost& = {});

}  // namespace batten::cli
