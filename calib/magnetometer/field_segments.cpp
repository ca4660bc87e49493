// SPDX-License-Identifier: Apache-2.0
#include "calib/magnetometer/field_segments.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "base/symmetric_solve.h"

namespace navcal::calib {
namespace {

using Cell = FieldCells<3, 6>::Cell;
using Shape = EllipsoidShape;

constexpr int kMostIterations = 60;
constexpr double kSettled = 1e-3, kSettledShare = 1e-5;  // gain of cost below which an iteration brings nothing
constexpr double kOutlier2 = 36;      // squares of single readings beyond grow as their logarithm
constexpr double kSingleReading = 3;  // a cell of so few may be an outlier

/// Squares, or what is made of those of single readings that may be outliers.
struct Loss {
  bool robust = false;

  [[nodiscard]] bool is_plain(double square, double count) const {
    return !robust || square <= kOutlier2 || count > kSingleReading;
  }
  [[nodiscard]] double cost(double square, double count) const {
    return is_plain(square, count) ? square : kOutlier2 * (1 + std::log(square / kOutlier2));
  }
  [[nodiscard]] double weight(double square, double count) const {
    return is_plain(square, count) ? 1 : kOutlier2 / square;
  }
};

/// The belief as information about the ten parameters.
struct Prior {
  Shape::Vector mean = Shape::Vector::Zero();
  Shape::Matrix information = Shape::Matrix::Zero();

  double per_step = 0;  ///< information of each component of a step

  explicit Prior(const SegmentBelief& belief) {
    const double per_uT = 1 / belief.field_uT;
    mean.segment<3>(3).setConstant(per_uT);
    mean[9] = belief.sine_of_dip;
    const auto inverse_square = [](double std) { return 1 / (std * std); };
    per_step = inverse_square(belief.centre_std_uT * per_uT);
    information.diagonal().head<3>().setConstant(per_step);
    // The size of the field is common to the three axes, soft iron is not.
    const double common = belief.field_std * belief.field_std, own = belief.soft_iron_std * belief.soft_iron_std;
    const Eigen::Matrix3d axes =
        (common * Eigen::Matrix3d::Ones() + own * Eigen::Matrix3d::Identity()) * per_uT * per_uT;
    information.block<3, 3>(3, 3) = axes.inverse();
    information.diagonal().segment<3>(6).setConstant(inverse_square(belief.soft_iron_std * per_uT));
    information(9, 9) = inverse_square(belief.sine_of_dip_std);
  }
};

/// Fit in progress, as an affine map: u = M m + b + e_k, e of the first segment zero. In these parameters the line
/// of the dip is linear and that of the size quadratic, so that iterations reach a minimum that is far away.
struct State {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
  double sine_of_dip = 0;
  std::vector<Eigen::Vector3d> steps;

  State(const Shape& shape, std::size_t segments)
      : matrix(shape.matrix_per_uT), shift(-shape.matrix_per_uT * shape.centre_uT), sine_of_dip(shape.sine_of_dip),
        steps(segments - 1, Eigen::Vector3d::Zero()) {}

  [[nodiscard]] Shape in(std::size_t segment) const {
    const Eigen::Vector3d there = segment == 0 ? shift : Eigen::Vector3d(shift + steps[segment - 1]);
    return {-matrix.inverse() * there, matrix, sine_of_dip};
  }
  [[nodiscard]] Shape::Vector parameters() const {
    Shape::Vector all;
    all << shift, matrix(0, 0), matrix(1, 1), matrix(2, 2), matrix(1, 2), matrix(0, 2), matrix(0, 1), sine_of_dip;
    return all;
  }
  [[nodiscard]] State moved(const Eigen::VectorXd& step) const {
    State next = *this;
    Shape shape{shift, matrix, sine_of_dip};
    shape = shape.moved(step.head<Shape::kParameters>());
    next.shift = shape.centre_uT;
    next.matrix = shape.matrix_per_uT;
    next.sine_of_dip = shape.sine_of_dip;
    for (std::size_t k = 0; k < steps.size(); ++k)
      next.steps[k] += step.segment<3>(Shape::kParameters + 3 * static_cast<Eigen::Index>(k));
    return next;
  }
  [[nodiscard]] bool sane() const {
    for (std::size_t k = 0; k <= steps.size(); ++k) {
      if (!in(k).sane()) return false;
    }
    return true;
  }
  /// d (centre, M, sine of dip) / d (shift, M, sine of dip) in one segment.
  [[nodiscard]] Shape::Matrix slope_of_shape(const Eigen::Vector3d& centre_uT) const {
    const Eigen::Matrix3d inverse = matrix.inverse();
    Shape::Matrix slope = Shape::Matrix::Identity();
    slope.topLeftCorner<3, 3>() = -inverse;
    slope.block<3, 6>(0, 3) = -inverse * Shape::slope_of_matrix(centre_uT);
    return slope;
  }
};

/// Cost function of the fit and its parts.
struct Problem {
  Segments segments;
  const SegmentNoise& noise;
  const Prior& prior;
  Loss loss;

  [[nodiscard]] double prior_cost(const State& state) const {
    const Shape::Vector off = state.parameters() - prior.mean;
    double cost = off.dot(prior.information * off);
    for (const auto& step : state.steps) cost += prior.per_step * step.squaredNorm();
    return cost;
  }
  [[nodiscard]] double cost(const State& state) const {
    double cost = prior_cost(state);
    for (std::size_t k = 0; k < segments.size(); ++k) {
      const Shape here = state.in(k);
      for (const Cell& cell : *segments[k])
        cost += loss.cost(segment_residual(here, cell, noise).square(), cell.count);
    }
    return cost;
  }
};

/// The normal equations at a state.
struct Normal {
  Eigen::MatrixXd information;
  Eigen::VectorXd gradient;
  double cost = 0;

  Normal(const Problem& problem, const State& state) {
    constexpr Eigen::Index kShape = Shape::kParameters;
    const auto size = kShape + 3 * static_cast<Eigen::Index>(state.steps.size());
    information = Eigen::MatrixXd::Zero(size, size);
    gradient = Eigen::VectorXd::Zero(size);
    information.topLeftCorner<kShape, kShape>() = problem.prior.information;
    gradient.head<kShape>() = problem.prior.information * (problem.prior.mean - state.parameters());
    for (std::size_t k = 0; k < state.steps.size(); ++k) {
      const auto at = kShape + 3 * static_cast<Eigen::Index>(k);
      information.block<3, 3>(at, at).diagonal().setConstant(problem.prior.per_step);
      gradient.segment<3>(at) = -problem.prior.per_step * state.steps[k];
    }
    cost = problem.prior_cost(state);
    for (std::size_t k = 0; k < problem.segments.size(); ++k) add(problem, state, k);
  }

 private:
  void add(const Problem& problem, const State& state, std::size_t segment) {
    const Shape shape = state.in(segment);
    Shape::Matrix sum = Shape::Matrix::Zero();
    Shape::Vector right = Shape::Vector::Zero();
    for (const Cell& cell : *problem.segments[segment]) {
      const SegmentResidual residual = segment_residual(shape, cell, problem.noise);
      const double square = residual.square();
      cost += problem.loss.cost(square, cell.count);
      const Eigen::Matrix<double, Shape::kParameters, 2> weighted =
          problem.loss.weight(square, cell.count) * residual.slope.transpose() * residual.variance.inverse();
      sum += weighted.lazyProduct(residual.slope);
      right -= weighted * residual.value;
    }
    const Shape::Matrix slope = state.slope_of_shape(shape.centre_uT);
    sum = (slope.transpose() * sum * slope).eval();
    right = (slope.transpose() * right).eval();
    information.topLeftCorner<Shape::kParameters, Shape::kParameters>() += sum;
    gradient.head<Shape::kParameters>() += right;
    if (segment == 0) return;
    // A departure depends on a segment's step as on the shift.
    const auto at = Shape::kParameters + 3 * static_cast<Eigen::Index>(segment - 1);
    information.block<3, 3>(at, at) += sum.topLeftCorner<3, 3>();
    information.block<3, Shape::kParameters>(at, 0) += sum.topRows<3>();
    information.block<Shape::kParameters, 3>(0, at) += sum.leftCols<3>();
    gradient.segment<3>(at) += right.head<3>();
  }
};

/// Each parameter is scaled by its own certainty, so that uT and 1/uT are comparable.
Eigen::MatrixXd inverse_of(const Eigen::MatrixXd& information, double damping) {
  const Eigen::VectorXd scale = information.diagonal().cwiseSqrt().cwiseInverse();
  Eigen::MatrixXd scaled = scale.asDiagonal() * information * scale.asDiagonal();
  scaled.diagonal() *= 1 + damping + 1e-12;
  return scale.asDiagonal() * base::inverse_symmetric(scaled) * scale.asDiagonal();
}

/// Step of a segment from the shift of the first, the shape being held: |v + e|^2 = 1 and down'(v + e) = sine of
/// dip, v = M m + b, linear in e and its square. A step larger than the field is far from where iterations from
/// none end.
Eigen::Vector3d step_of(const EllipsoidCells& cells, const State& state) {
  constexpr double kRidge = 1e-6;  // in directions that no reading determines there is no step
  Eigen::Matrix4d normal = kRidge * Eigen::Matrix4d::Identity();
  Eigen::Vector4d right = Eigen::Vector4d::Zero();
  for (const Cell& cell : cells) {
    const Eigen::Vector3d v = state.matrix * cell.mean.head<3>() + state.shift, down = cell.mean.tail<3>();
    const Eigen::Vector4d by_size(2 * v.x(), 2 * v.y(), 2 * v.z(), 1), by_dip(down.x(), down.y(), down.z(), 0);
    normal += by_size * by_size.transpose() + by_dip * by_dip.transpose();
    right += by_size * (1 - v.squaredNorm());
    if (!down.isZero(0)) right += by_dip * (state.sine_of_dip - down.dot(v));
  }
  return base::solve_symmetric(normal, right).topRows<3>();
}

/// Minimises the cost from `state` to the nearest local minimum.
SegmentsFit minimised(const Problem& problem, State& state) {
  SegmentsFit fit;
  double damping = 0;
  Normal normal(problem, state);
  for (int i = 0; i < kMostIterations && !fit.converged; ++i) {
    const State next = state.moved(inverse_of(normal.information, damping) * normal.gradient);
    const double cost = next.sane() ? problem.cost(next) : INFINITY;
    const double settled = kSettled + kSettledShare * normal.cost;
    if (cost <= normal.cost + settled) {
      fit.converged = normal.cost - cost < settled;
      state = next;
      normal = Normal(problem, state);
      damping = damping > 1e-6 ? damping / 10 : 0;
    } else {
      fit.converged = damping > 1e4;
      damping = std::max(10 * damping, 1e-4);
    }
  }
  fit.shape = state.in(0);
  for (std::size_t k = 0; k < problem.segments.size(); ++k) fit.centres_uT.push_back(state.in(k).centre_uT);
  // The covariance is expressed in the centres and their differences.
  Eigen::MatrixXd slope = Eigen::MatrixXd::Identity(normal.information.rows(), normal.information.cols());
  slope.topLeftCorner<Shape::kParameters, Shape::kParameters>() = state.slope_of_shape(fit.shape.centre_uT);
  for (std::size_t k = 1; k < problem.segments.size(); ++k) {
    const auto at = Shape::kParameters + 3 * static_cast<Eigen::Index>(k - 1);
    const Shape::Matrix of_step = state.slope_of_shape(fit.centres_uT[k] - fit.shape.centre_uT);
    slope.block<3, 3>(at, at) = of_step.topLeftCorner<3, 3>();
    slope.block<3, 6>(at, 3) = of_step.block<3, 6>(0, 3);
  }
  fit.covariance = slope * inverse_of(normal.information, 0) * slope.transpose();
  fit.cost = normal.cost;
  return fit;
}

}  // namespace

SegmentBelief SegmentBelief::about(const std::optional<KnownField>& known) {
  SegmentBelief belief;
  if (!known) return belief;
  belief.field_uT = known->magnitude_uT;
  belief.field_std = known->magnitude_std_uT / known->magnitude_uT;
  belief.sine_of_dip = std::sin(known->dip_rad);
  belief.sine_of_dip_std = std::max(0.1, std::cos(known->dip_rad)) * known->dip_std_rad;
  return belief;
}

double SegmentResidual::square(const EllipsoidShape::Matrix& covariance) const {
  if (freedom == 1) {
    const auto row = slope.row(0);
    return value[0] * value[0] / (variance(0, 0) + row.dot(covariance * row.transpose()));
  }
  const Eigen::Matrix2d total = variance + slope * covariance * slope.transpose();
  return value.dot(total.inverse() * value);
}

double SegmentResidual::square() const { return value.dot(variance.inverse() * value); }

SegmentResidual segment_residual(const EllipsoidShape& shape, const FieldCells<3, 6>::Cell& cell,
                                 const SegmentNoise& noise) {
  const Eigen::Matrix3d& m = shape.matrix_per_uT;
  const Eigen::Vector3d off_centre = cell.mean.head<3>() - shape.centre_uT;
  const Eigen::Vector3d down = cell.mean.tail<3>();
  const Eigen::Vector3d unit = m * off_centre;
  const double size = std::max(unit.norm(), 1e-6);
  const Eigen::Vector3d direction = unit / size;
  const Eigen::Vector3d by_size = m * direction, by_dip = m * down;
  const auto slope = EllipsoidShape::slope_of_matrix(off_centre);
  const double field2 = noise.field_uT * noise.field_uT / cell.count;
  // The mean of readings on a curved surface lies inside it.
  const Eigen::Matrix3d spread = m.lazyProduct(cell.scatter.topLeftCorner<3, 3>() / cell.count).lazyProduct(m);
  const double sagitta = 0.5 * (spread.trace() - direction.dot(spread * direction)) / size;

  SegmentResidual residual;
  residual.value = {size + sagitta - 1, 0};
  residual.variance = Eigen::Matrix2d::Identity();
  // All errors are in uT: of errors relative to the fitted size a shape without bounds would have none.
  residual.variance(0, 0) = (field2 + noise.model_uT * noise.model_uT) * by_size.squaredNorm();
  residual.slope.row(0) << -by_size.transpose(), (slope.transpose() * direction).transpose(), 0;
  residual.freedom = down.isZero(0) ? 1 : 2;
  if (residual.freedom == 1) return residual;
  const double joint = m.cwiseProduct(cell.scatter.topRightCorner<3, 3>()).sum() / cell.count;
  residual.value[1] = down.dot(unit) + joint - shape.sine_of_dip;
  const double across2 = std::max(0.05, 1 - shape.sine_of_dip * shape.sine_of_dip);
  const double tilt2 = noise.tilt_rad * noise.tilt_rad / cell.count + noise.tilt_error_rad * noise.tilt_error_rad;
  constexpr double kUsualField_uT = 45;
  residual.variance(1, 1) = (field2 + across2 * tilt2 * kUsualField_uT * kUsualField_uT) * by_dip.squaredNorm();
  residual.variance(0, 1) = residual.variance(1, 0) = field2 * by_size.dot(by_dip);
  residual.slope.row(1) << -by_dip.transpose(), (slope.transpose() * down).transpose(), -1;
  return residual;
}

SegmentResidual predicted_residual(const EllipsoidShape& shape, const FieldCells<3, 6>::Cell& reading,
                                   const SegmentNoise& noise) {
  constexpr int kSteps = 3;
  Cell nearest = reading;
  for (int i = 0; i < kSteps; ++i) {
    const SegmentResidual r = segment_residual(shape, nearest, noise);
    const Eigen::Matrix<double, 2, 3> by_field = -r.slope.leftCols<3>();
    if (r.freedom == 1) {
      nearest.mean.head<3>() -= by_field.row(0).transpose() * (r.value[0] / by_field.row(0).squaredNorm());
      continue;
    }
    Eigen::Matrix2d square = by_field * by_field.transpose();
    square.diagonal() *= 1 + 1e-6;  // field and plumb line may be parallel
    nearest.mean.head<3>() -= by_field.transpose() * square.inverse() * r.value;
  }
  SegmentResidual residual = segment_residual(shape, reading, noise);
  const SegmentResidual there = segment_residual(shape, nearest, noise);
  if (!there.slope.allFinite()) return residual;
  residual.slope = there.slope;
  residual.variance = there.variance;
  return residual;
}

std::optional<SegmentsFit> fit_segments(Segments segments, const SegmentNoise& noise, const SegmentBelief& belief,
                                        const EllipsoidShape* begin) {
  const Prior prior(belief);
  Problem problem{segments, noise, prior, {}};
  std::optional<State> state;
  std::optional<SegmentsFit> fit;
  const auto try_from = [&](State attempt) {
    SegmentsFit found = minimised(problem, attempt);
    if (fit && fit->cost <= found.cost) return;
    fit = std::move(found);
    state = std::move(attempt);
  };
  if (begin != nullptr) {
    State held(*begin, segments.size());
    try_from(held);
    for (std::size_t k = 1; k < segments.size(); ++k) held.steps[k - 1] = step_of(*segments[k], held);
    if (segments.size() > 1 && held.sane()) try_from(held);
  } else {
    for (const auto* segment : segments) {
      if (const auto sphere = starting_sphere(*segment, {})) try_from(State(*sphere, segments.size()));
    }
  }
  if (!state) return std::nullopt;
  // Robust weights have many minima: theirs is looked for from the least of the squares.
  problem.loss.robust = true;
  return minimised(problem, *state);
}

SizeSpread spread_of(const EllipsoidCells& cells, const Eigen::Matrix3d& matrix,
                     const Eigen::Vector3d& centre_uT) {
  double count = 0, mean = 0, squares = 0;
  for (const Cell& cell : cells) {
    const Eigen::Vector3d unit = matrix * (cell.mean.head<3>() - centre_uT);
    const double size = std::max(unit.norm(), 1e-9);
    const Eigen::Vector3d direction = unit / size;
    const Eigen::Matrix3d spread = matrix * (cell.scatter.topLeftCorner<3, 3>() / cell.count) * matrix.transpose();
    const double along = direction.dot(spread * direction);
    const double mean_size = size + 0.5 * (spread.trace() - along) / size;
    const double apart = mean_size - mean, total = count + cell.count;
    squares += cell.count * along + count * cell.count / total * apart * apart;
    mean += cell.count / total * apart;
    count = total;
  }
  return {mean, count > 1 ? std::sqrt(squares / (count - 1)) : 0};
}

}  // namespace navcal::calib
