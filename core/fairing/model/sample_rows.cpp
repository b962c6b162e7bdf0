// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/model/sample_rows.h"

#include <algorithm>
#include <array>
#include <span>
#include <type_traits>
#include <utility>

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
  if (Stride == kFreeQuintic && index.size() == kFreeQuintic) {  // the usual case, of a length that is known
    for (int k = 0; k < kFreeQuintic; ++k) near[k] = all[index[k]];
    return;
  }
  near.setZero();
  for (std::size_t k = 0; k < index.size(); ++k) near[static_cast<Eigen::Index>(k)] = all[index[k]];
}
template <int Stride>
void scatter(std::span<const int> index, const Near<Stride>& near, Eigen::VectorXd& all) {
  if (Stride == kFreeQuintic && index.size() == kFreeQuintic) {
    for (int k = 0; k < kFreeQuintic; ++k) all[index[k]] = near[k];
    return;
  }
  for (std::size_t k = 0; k < index.size(); ++k) all[index[k]] = near[static_cast<Eigen::Index>(k)];
}

/// Rows `From` to `From` + 3 of the squares of samples of one span, from that column on: what lies left of the diagonal
/// is not read. The sums of a row stay in registers; they are added to in the order of the samples.
template <int From>
BATTEN_PART_OF_LOOP void addFourRows(const double* rows, int samples, const SampleRows::Squares& squares,
                                     const SampleRows::SquareWeights* weights, double* __restrict stiff,
                                     double* __restrict mass) {
  constexpr int kFours = (kFreeQuintic - From) / 4;
  const double unit = squares.unit, floor = squares.floor, slide = squares.slide;
  for (int b = From; b < From + 4; ++b) {
    double *stiffRow = stiff + kFreeQuintic * b + From, *massRow = mass + kFreeQuintic * b + From;
    std::array<std::array<double, 4>, kFours> s, m;
    for (int g = 0; g < kFours; ++g)
      for (int l = 0; l < 4; ++l) s[g][l] = stiffRow[4 * g + l];
    for (int g = 0; g < kFours; ++g)
      for (int l = 0; l < 4; ++l) m[g][l] = massRow[4 * g + l];
    const double* curvature = rows;
    for (int i = 0; i < samples; ++i, curvature += SampleRows::kRows * kFreeQuintic) {
      const double *across = curvature + kFreeQuintic, *along = across + kFreeQuintic;
      const double c = weights[i].curvature * curvature[b], f = weights[i].across * across[b], n = unit * across[b],
                   t = unit * along[b];
      const double held = floor * t, slides = slide * t;
      for (int g = 0; g < kFours; ++g) {
        const int at = From + 4 * g;
        for (int l = 0; l < 4; ++l) s[g][l] += c * curvature[at + l] + f * across[at + l] + held * along[at + l];
        for (int l = 0; l < 4; ++l) m[g][l] += n * across[at + l] + slides * along[at + l];
      }
    }
    for (int g = 0; g < kFours; ++g)
      for (int l = 0; l < 4; ++l) stiffRow[4 * g + l] = s[g][l];
    for (int g = 0; g < kFours; ++g)
      for (int l = 0; l < 4; ++l) massRow[4 * g + l] = m[g][l];
  }
}
BATTEN_HOT_LOOP void addQuinticSquares(const double* rows, int samples, const SampleRows::Squares& squares,
                                       const SampleRows::SquareWeights* weights, double* __restrict stiff,
                                       double* __restrict mass) {
  addFourRows<0>(rows, samples, squares, weights, stiff, mass);
  addFourRows<4>(rows, samples, squares, weights, stiff, mass);
  addFourRows<8>(rows, samples, squares, weights, stiff, mass);
}
/// Rows of the samples of one span.
struct SpanRows {
  const double* first;
  int samples, stride;
};
void addAnySquares(const SpanRows& span, const SampleRows::Squares& squares, const SampleRows::SquareWeights* weights,
                   double* stiff, double* mass) {
  const auto [first, samples, stride] = span;
  const double* rows = first;
  for (int i = 0; i < samples; ++i, rows += static_cast<std::ptrdiff_t>(SampleRows::kRows) * stride) {
    const double *across = rows + stride, *along = across + stride;
    for (int b = 0; b < stride; ++b) {
      const double c = weights[i].curvature * rows[b], f = weights[i].across * across[b], n = squares.unit * across[b],
                   t = squares.unit * along[b];
      const double held = squares.floor * t, slides = squares.slide * t;
      for (int a = b; a < stride; ++a) {
        stiff[stride * b + a] += c * rows[a] + f * across[a] + held * along[a];
        mass[stride * b + a] += n * across[a] + slides * along[a];
      }
    }
  }
}

/// Between a square of numbers and the rows of a matrix, which begin at their diagonals.
using Triangle = std::make_index_sequence<kFreeQuintic>;
template <std::size_t... kRow>
void copyFrom(const double* rows, std::size_t width, double* square, std::index_sequence<kRow...>) {
  (std::copy_n(rows + kRow * width, kFreeQuintic - kRow, square + kRow * (kFreeQuintic + 1)), ...);
}
template <std::size_t... kRow>
void copyTo(double* rows, std::size_t width, const double* square, std::index_sequence<kRow...>) {
  (std::copy_n(square + kRow * (kFreeQuintic + 1), kFreeQuintic - kRow, rows + kRow * width), ...);
}

/// Calls `body` with an entry of the matrix, and its place in the square of a span's unknowns.
template <class Body>
void eachEntry(std::span<const int> index, int stride, BandedMatrix& matrix, const Body& body) {
  for (std::size_t b = 0; b < index.size(); ++b) {
    double* entries = &matrix.entry(index[b], 0);
    const std::size_t diagonal = b * (stride + 1);
    for (std::size_t k = 0; k < index.size() - b; ++k) body(entries[index[b + k] - index[b]], diagonal + k);
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
  for (const SampleRun& run : runs_) body(run, unknowns_->indices(run.span));
}

void SampleRows::reset(const Unknowns& unknowns, const EqualArc& arc) {
  unknowns_ = &unknowns;
  stride_ = unknowns.stride();
  count_ = static_cast<int>(arc.places.size());
  values_.resize(offset(count_, Curvature));
  runs_.clear();
  for (int i = 0; i < count_; ++i) {
    const int span = arc.places[i].span;
    if (i == 0 || arc.places[i - 1].span != span) runs_.push_back({i, i, span});
    runs_.back().end = i + 1;
  }
}

void SampleRows::set(int sample, Row row, int span, const LocalRow& overPoints) {
  double* values = &values_[offset(sample, row)];
  unknowns_->reduce(span, overPoints, values);
  std::fill(values + unknowns_->indices(span).size(), values + stride_, 0.0);
}

SampleRows::Products SampleRows::times(const Eigen::VectorXd& v) const {
  Products products{Eigen::VectorXd(count_), Eigen::VectorXd(count_), Eigen::VectorXd(count_)};
  withStride([&](auto stride) {
    Near<stride()> near(stride_);
    eachRun([&](const SampleRun& run, std::span<const int> index) {
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
  eachRun([&](const SampleRun& run, std::span<const int> index) {
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
    eachRun([&](const SampleRun& run, std::span<const int> index) {
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
    eachRun([&](const SampleRun& run, std::span<const int> index) {
      gather<stride()>(index, out, near);
      for (int i = run.begin; i < run.end; ++i) near += ofAcross[i] * NearRow<stride()>(row(i, Across), stride_);
      scatter<stride()>(index, near, out);
    });
  });
}

void SampleRows::addTransposedSums(const Products& factors, Eigen::VectorXd& out) const {
  withStride([&](auto stride) {
    Near<stride()> near(stride_);
    eachRun([&](const SampleRun& run, std::span<const int> index) {
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
  std::vector<double> stiff(std::ptrdiff_t{stride_} * stride_);
  std::vector<double> heavy(stiff.size());
  const std::size_t width = stiffness.halfWidth() + 1;
  eachRun([&](const SampleRun& run, std::span<const int> index) {
    if (index.empty() || check.isCancelled()) return;
    const double* rows = row(run.begin, Curvature);
    const SquareWeights* weights = &squares.weights[run.begin];
    const int samples = run.end - run.begin;
    double *ofStiffness = &stiffness.entry(index.front(), 0), *ofMass = &mass.entry(index.front(), 0);
    const bool isInOrder = index.back() - index.front() + 1 == std::ssize(index);
    if (stride_ == kFreeQuintic && index.size() == kFreeQuintic && isInOrder) {  // the usual case
      copyFrom(ofStiffness, width, stiff.data(), Triangle());
      copyFrom(ofMass, width, heavy.data(), Triangle());
      addQuinticSquares(rows, samples, squares, weights, stiff.data(), heavy.data());
      copyTo(ofStiffness, width, stiff.data(), Triangle());
      copyTo(ofMass, width, heavy.data(), Triangle());
      return;
    }
    eachEntry(index, stride_, stiffness, [&](double entry, std::size_t place) { stiff[place] = entry; });
    eachEntry(index, stride_, mass, [&](double entry, std::size_t place) { heavy[place] = entry; });
    if (stride_ == kFreeQuintic) {
      addQuinticSquares(rows, samples, squares, weights, stiff.data(), heavy.data());
    } else {
      addAnySquares({rows, samples, stride_}, squares, weights, stiff.data(), heavy.data());
    }
    eachEntry(index, stride_, stiffness, [&](double& entry, std::size_t place) { entry = stiff[place]; });
    eachEntry(index, stride_, mass, [&](double& entry, std::size_t place) { entry = heavy[place]; });
  });
}

}  // namespace batten
