// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/model/sample_rows.h"

#include <array>
#include <span>
#include <type_traits>

#include "core/base/hot_loop.h"

namespace batten {
namespace {

constexpr int kFreeQuintic = 12;  // unknowns of a span whose control points are all free: the usual case, in registers

template <int Stride>
using Near = Eigen::Matrix<double, Stride, 1>;  // values over the unknowns of a span
template <int Stride>
using NearRow = Eigen::Map<const Near<Stride>>;

template <int Stride>
void gather(std::span<const int> index, const Eigen::VectorXd& all, Near<Stride>& near) {
  near.setZero();
  for (std::size_t k = 0; k < index.size(); ++k) near[static_cast<Eigen::Index>(k)] = all[index[k]];
}
template <int Stride>
void scatter(std::span<const int> index, const Near<Stride>& near, Eigen::VectorXd& all) {
  for (std::size_t k = 0; k < index.size(); ++k) all[index[k]] = near[static_cast<Eigen::Index>(k)];
}

/// The rows of a sample with the factors of their squares.
struct SquaredRows {
  const double *curvature, *across, *along;
  double ofCurvature, ofAcross, unit, floor, slide;
};

/// Rows from..from + 3 of the squares, from their first column of four on: what lies left of the diagonal is not read.
template <int From>
BATTEN_PART_OF_LOOP void addFourSquares(const SquaredRows& rows, double* __restrict stiff, double* __restrict mass) {
  for (int b = From; b < From + 4; ++b) {
    const double c = rows.ofCurvature * rows.curvature[b], f = rows.ofAcross * rows.across[b],
                 n = rows.unit * rows.across[b], t = rows.unit * rows.along[b];
    const double held = rows.floor * t, slides = rows.slide * t;
    for (int a = From; a < kFreeQuintic; ++a) {
      stiff[kFreeQuintic * b + a] += c * rows.curvature[a] + f * rows.across[a] + held * rows.along[a];
      mass[kFreeQuintic * b + a] += n * rows.across[a] + slides * rows.along[a];
    }
  }
}
BATTEN_HOT_LOOP void addQuinticSquares(const SquaredRows& rows, double* __restrict stiff, double* __restrict mass) {
  addFourSquares<0>(rows, stiff, mass);
  addFourSquares<4>(rows, stiff, mass);
  addFourSquares<8>(rows, stiff, mass);
}
void addSquaresOf(int stride, const SquaredRows& rows, double* stiff, double* mass) {
  if (stride == kFreeQuintic) return addQuinticSquares(rows, stiff, mass);
  for (int b = 0; b < stride; ++b) {
    const double c = rows.ofCurvature * rows.curvature[b], f = rows.ofAcross * rows.across[b],
                 n = rows.unit * rows.across[b], t = rows.unit * rows.along[b];
    const double held = rows.floor * t, slides = rows.slide * t;
    for (int a = b; a < stride; ++a) {
      stiff[stride * b + a] += c * rows.curvature[a] + f * rows.across[a] + held * rows.along[a];
      mass[stride * b + a] += n * rows.across[a] + slides * rows.along[a];
    }
  }
}

/// Calls `body` with an entry of the matrix, and its place in the square of a span's unknowns.
template <class Body>
void eachEntry(std::span<const int> index, int stride, BandedMatrix& matrix, const Body& body) {
  for (std::size_t b = 0; b < index.size(); ++b) {
    double* entries = &matrix.entry(index[b], 0);
    for (std::size_t a = b; a < index.size(); ++a) body(entries[index[a] - index[b]], b * stride + a);
  }
}

}  // namespace

/// Calls `body` with the stride as a constant where the compiler shall know it.
template <class Body>
void SampleRows::withStride(const Body& body) const {
  if (stride_ == kFreeQuintic) {
    body(std::integral_constant<int, kFreeQuintic>());
  } else {
    body(std::integral_constant<int, Eigen::Dynamic>());
  }
}

template <class Body>
void SampleRows::eachRun(const Body& body) const {
  for (const Run& run : runs_) body(run, unknowns_->indices(run.span));
}

void SampleRows::reset(const Unknowns& unknowns, const EqualArc& arc) {
  unknowns_ = &unknowns;
  stride_ = unknowns.stride();
  count_ = static_cast<int>(arc.places.size());
  values_.assign(offset(count_, Curvature), 0.0);
  runs_.clear();
  for (int i = 0; i < count_; ++i) {
    const int span = arc.places[i].span;
    if (runs_.empty() || runs_.back().span != span) runs_.push_back({i, i, span});
    runs_.back().end = i + 1;
  }
}

SampleRows::Products SampleRows::times(const Eigen::VectorXd& v) const {
  Products products{Eigen::VectorXd(count_), Eigen::VectorXd(count_), Eigen::VectorXd(count_)};
  withStride([&](auto stride) {
    Near<stride()> near(stride_);
    eachRun([&](const Run& run, std::span<const int> index) {
      gather<stride()>(index, v, near);
      for (int i = run.begin; i < run.end; ++i) {
        products.curvature[i] = NearRow<stride()>(row(i, Curvature), stride_).dot(near);
        products.across[i] = NearRow<stride()>(row(i, Across), stride_).dot(near);
        products.along[i] = NearRow<stride()>(row(i, Along), stride_).dot(near);
      }
    });
  });
  return products;
}

Eigen::VectorXd SampleRows::acrossTimes(const Eigen::VectorXd& v) const {
  Eigen::VectorXd result(count_);
  eachRun([&](const Run& run, std::span<const int> index) {
    for (int i = run.begin; i < run.end; ++i) {
      const double* values = row(i, Across);
      double sum = 0.0;
      for (std::size_t k = 0; k < index.size(); ++k) sum += values[k] * v[index[k]];
      result[i] = sum;
    }
  });
  return result;
}

void SampleRows::addFirstAlong(double factor, Eigen::VectorXd& out) const {
  const auto index = unknowns_->indices(runs_.front().span);
  const double* values = row(0, Along);
  for (std::size_t k = 0; k < index.size(); ++k) out[index[k]] += factor * values[k];
}

void SampleRows::addTransposed(const Eigen::VectorXd& ofCurvature, const Eigen::VectorXd& ofAcross,
                               Eigen::VectorXd& out) const {
  withStride([&](auto stride) {
    Near<stride()> near(stride_);
    eachRun([&](const Run& run, std::span<const int> index) {
      gather<stride()>(index, out, near);
      for (int i = run.begin; i < run.end; ++i) {
        near += ofCurvature[i] * NearRow<stride()>(row(i, Curvature), stride_);
        near += ofAcross[i] * NearRow<stride()>(row(i, Across), stride_);
      }
      scatter<stride()>(index, near, out);
    });
  });
}

void SampleRows::addTransposed(const Eigen::VectorXd& ofAcross, Eigen::VectorXd& out) const {
  withStride([&](auto stride) {
    Near<stride()> near(stride_);
    eachRun([&](const Run& run, std::span<const int> index) {
      gather<stride()>(index, out, near);
      for (int i = run.begin; i < run.end; ++i) near += ofAcross[i] * NearRow<stride()>(row(i, Across), stride_);
      scatter<stride()>(index, near, out);
    });
  });
}

void SampleRows::addTransposedSums(const Products& factors, Eigen::VectorXd& out) const {
  withStride([&](auto stride) {
    Near<stride()> near(stride_);
    eachRun([&](const Run& run, std::span<const int> index) {
      gather<stride()>(index, out, near);
      for (int i = run.begin; i < run.end; ++i) {
        near += factors.curvature[i] * NearRow<stride()>(row(i, Curvature), stride_) +
                factors.across[i] * NearRow<stride()>(row(i, Across), stride_) +
                factors.along[i] * NearRow<stride()>(row(i, Along), stride_);
      }
      scatter<stride()>(index, near, out);
    });
  });
}

void SampleRows::addSquares(const Squares& squares, CancelCheck check, BandedMatrix& stiffness,
                            BandedMatrix& mass) const {
  std::vector<double> stiff(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(stride_));
  std::vector<double> heavy(stiff.size());
  eachRun([&](const Run& run, std::span<const int> index) {
    if (check.isCancelled()) return;
    eachEntry(index, stride_, stiffness, [&](double entry, std::size_t place) { stiff[place] = entry; });
    eachEntry(index, stride_, mass, [&](double entry, std::size_t place) { heavy[place] = entry; });
    for (int i = run.begin; i < run.end; ++i) {
      const SquareWeights& weights = squares.weights[i];
      addSquaresOf(stride_,
                   {row(i, Curvature), row(i, Across), row(i, Along), weights.curvature, weights.across, squares.unit,
                    squares.floor, squares.slide},
                   stiff.data(), heavy.data());
    }
    eachEntry(index, stride_, stiffness, [&](double& entry, std::size_t place) { entry = stiff[place]; });
    eachEntry(index, stride_, mass, [&](double& entry, std::size_t place) { entry = heavy[place]; });
  });
}

}  // namespace batten
