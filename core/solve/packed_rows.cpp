// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solve/packed_rows.h"

#include <algorithm>
#include <cassert>
#include <cstddef>

namespace batten {

PackedRows::PackedRows(std::span<const BandRow> rows, int unknowns) : source_(rows) {
  const std::ptrdiff_t count = std::ssize(rows);
  rows_.assign(count * RowFours::kRowStride, 0.0);
  fours_.reserve(rows.size());
  std::vector<std::ptrdiff_t> begins;  // of sections, in fours
  for (int i = 0; i < count; ++i) {
    const BandRow& row = rows[i];
    if (row.first + static_cast<int>(row.v.size()) > unknowns) {
      sections_.push_back({{}, &row, i});
      begins.push_back(std::ssize(fours_));
      continue;
    }
    const bool begins4 = sections_.empty() || sections_.back().across != nullptr;
    if (begins4) {
      sections_.push_back({{}, nullptr, i});
      begins.push_back(std::ssize(fours_));
    }
    if (begins4 || fours_.back().first != row.first || fours_.back().count == RowFours::kLanes) {
      fours_.push_back({row.first, i, 0});
      lanes_.resize(lanes_.size() + RowFours::kLaneStride, 0.0);
    }
    double* lanes = lanes_.data() + (std::ssize(fours_) - 1) * RowFours::kLaneStride + fours_.back().count++;
    double* own = rows_.data() + std::ptrdiff_t{i} * RowFours::kRowStride;
    for (std::size_t k = 0; k < row.v.size(); ++k) own[k] = lanes[RowFours::kLanes * k] = row.v[k];
  }
  begins.push_back(std::ssize(fours_));
  for (std::size_t s = 0; s < sections_.size(); ++s) {
    sections_[s].fours = {fours_.data() + begins[s], static_cast<int>(begins[s + 1] - begins[s]), rows_.data(),
                          lanes_.data() + begins[s] * RowFours::kLaneStride};
  }
}

void PackedRows::times(const Eigen::VectorXd& x, Eigen::VectorXd& out) const {
  out.resize(count());
  for (const Section& section : sections_) {
    if (section.across) {
      out[section.row] = dot(*section.across, x);
    } else {
      bandKernels().times(section.fours, x.data(), out.data());
    }
  }
}

void PackedRows::addTransposed(const Eigen::VectorXd& weight, Eigen::VectorXd& x) const {
  for (const Section& section : sections_) {
    if (section.across) {
      addTo(x, *section.across, weight[section.row]);
    } else {
      bandKernels().addTransposed(section.fours, weight.data(), x.data());
    }
  }
}

void PackedRows::addOuter(const Eigen::VectorXd& weight, BandedMatrix& m) const {
  assert(m.halfWidth() == BandRow::kHalfWidth);
  for (const Section& section : sections_) {
    if (section.across) {
      m.addOuter(*section.across, weight[section.row]);
    } else {
      bandKernels().addOuter(section.fours, weight.data(), &m.entry(0, 0));
    }
  }
}

}  // namespace batten
