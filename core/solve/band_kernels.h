// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace batten {

/// Up to four rows after each other over the same six unknowns.
struct RowFour {
  int first = 0;  ///< Unknown.
  int row = 0;    ///< The first of them.
  int count = 0;  ///< 1..4
};

/// Rows of a program, in order, by fours.
struct RowFours {
  static constexpr int kWidth = 6;        ///< Numbers of a row: those of BandRow.
  static constexpr int kLanes = 4;        ///< Most rows of a four.
  static constexpr int kRowStride = 10;   ///< From row to row: behind its numbers zeros, to read four from each on.
  static constexpr int kLaneStride = 24;  ///< From four to four: the first numbers of its rows, then the second ...
  const RowFour* fours = nullptr;
  int count = 0;
  const double* rows = nullptr;   ///< Of row 0 on.
  const double* lanes = nullptr;  ///< Of fours[0] on.
};

/// Products with such rows. All versions give the same bits where the weights are finite: sums are made in the order of
/// the rows, multiplied and added apart. addOuter() may add the zeros behind the numbers of a row, too, and zero times
/// infinity is no number.
struct BandKernels {
  /// out[i] = row i . x.
  void (*times)(const RowFours&, const double* x, double* out);
  /// x += the sum of weight[i] * row i'.
  void (*addTransposed)(const RowFours&, const double* weight, double* x);
  /// The same of weight[i] * row i' row i; m as BandedMatrix has it: the entries (i, i) to (i, i + 5) at 6 i.
  void (*addOuter)(const RowFours&, const double* weight, double* m);
};

/// For any processor.
const BandKernels& plainBandKernels();
/// The fastest that this processor has.
const BandKernels& bandKernels();

}  // namespace batten
