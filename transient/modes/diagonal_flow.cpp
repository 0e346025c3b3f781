// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/modes/diagonal_flow.hpp"
#include "core/error.hpp"
#include "core/general_eigenvalues.hpp"
#include <algorithm>
#include <cmath>

namespace fretwork::transient {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double largest_condition = 1e6;
/// Blocks of fewer modes are put together: a pack of displacements and velocities takes no longer than one of them.
constexpr std::size_t modes_of_pack = kernels::lanes / 2;

int padded(std::size_t n) { return kernels::padded(static_cast<int>(n)); }

/// phi_1 and phi_2; the series where the closed forms would cancel.
std::pair<Complex, Complex> phi(Complex x) {
  if (std::abs(x) > 1.0) {
    const Complex one = (std::exp(x) - 1.0) / x;
    return {one, (one - 1.0) / x};
  }
  Complex two = 0.0, term = 0.5; // x^j/(j+2)!
  for (int j = 0; j < 20; ++j) {
    two += term;
    term *= x / (j + 3.0);
  }
  return {1.0 + x * two, two};
}

/// A of (q, v, z).
MatrixXd state_matrix(const System& system, const CoupledBlock& of) {
  const auto m = static_cast<Index>(of.modes.size()), r = static_cast<Index>(of.states.size());
  const core::MotionForces& f = system.motion;
  MatrixXd a = MatrixXd::Zero(2 * m + r, 2 * m + r);
  a.block(0, m, m, m).setIdentity();
  a.block(m, 0, m, m) = f.stiffness(of.modes, of.modes);
  a.block(m, 0, m, m) -= VectorXd(system.stiffness(of.modes)).asDiagonal();
  a.block(m, m, m, m) = f.damping(of.modes, of.modes);
  if (system.damping_matrix.size() > 0)
    a.block(m, m, m, m) -= system.damping_matrix(of.modes, of.modes);
  else
    a.block(m, m, m, m) -= VectorXd(system.damping(of.modes)).asDiagonal();
  a.block(m, 2 * m, m, r) = f.input(of.modes, of.states);
  a.block(2 * m, m, r, m) = f.output(of.states, of.modes);
  a.block(2 * m, 2 * m, r, r) = f.rates(of.states, of.states);
  return a;
}

/// Sizes of (q, v, z): w, 1, w_1.
VectorXd scales(const System& system, const CoupledBlock& of) {
  const auto m = static_cast<Index>(of.modes.size()), r = static_cast<Index>(of.states.size());
  VectorXd w = VectorXd(system.stiffness(of.modes)).cwiseSqrt();
  const double least = w.minCoeff() > 0.0 ? w.minCoeff() : 1.0;
  w = w.cwiseMax(least);
  VectorXd out(2 * m + r);
  out << w, VectorXd::Ones(m), VectorXd::Constant(r, least);
  return out;
}

kernels::Array in_tiles(const MatrixXd& x, int np) {
  const auto columns = static_cast<int>(x.cols());
  kernels::Array out(static_cast<std::size_t>(np) * static_cast<std::size_t>(columns), 0.0);
  for (int j = 0; j < columns; ++j)
    for (int i = 0; i < static_cast<int>(x.rows()); ++i)
      out[kernels::place_in_tiles(np, columns, i, j)] = x(i, j);
  return out;
}

std::vector<CoupledBlock> put_together(const std::vector<CoupledBlock>& blocks) {
  std::vector<CoupledBlock> out;
  for (const CoupledBlock& block : blocks) {
    if (out.empty() || out.back().modes.size() + block.modes.size() > modes_of_pack) {
      out.push_back(block);
      continue;
    }
    for (auto part : {&CoupledBlock::modes, &CoupledBlock::states}) {
      std::vector<Index>& to = out.back().*part;
      to.insert(to.end(), (block.*part).begin(), (block.*part).end());
    }
  }
  return out;
}

} // namespace

DiagonalFlow::DiagonalFlow(const Scene& scene, std::vector<CoupledBlock>& blocks, double step,
                           const std::vector<int>& lengths) {
  std::vector<CoupledBlock> left;
  for (const CoupledBlock& block : put_together(blocks))
    if (!add_block(scene.system, block, step, lengths))
      left.push_back(block);
  blocks = std::move(left);
  std::size_t width = 0, modes = 0, rows = 0;
  for (Block& b : blocks_) {
    add_rows(scene, b, step);
    width = std::max(width, static_cast<std::size_t>(b.width()));
    modes = std::max(modes, b.modes.size());
    rows = std::max(rows, static_cast<std::size_t>(b.rows));
  }
  for (kernels::Array* x : {&g0_, &g1_, &decay_})
    x->assign(width, 0.0);
  answer_.assign(2 * width, 0.0);
  for (kernels::Array* x : {&a_, &b_})
    x->assign(modes, 0.0);
  moved_.assign(rows, 0.0);
  inside_.assign(size_, 0.0);
  for (auto& list : parts_)
    list.resize(3 * scene.contacts.size());
  for (auto& list : factors_)
    list.resize(3 * scene.contacts.size());
}

bool DiagonalFlow::add_block(const System& system, const CoupledBlock& of, double step,
                             const std::vector<int>& lengths) {
  const auto m = static_cast<Index>(of.modes.size());
  const VectorXd scale = scales(system, of);
  const core::Diagonalised found =
      core::diagonalised(scale.asDiagonal() * state_matrix(system, of) * scale.cwiseInverse().asDiagonal());
  if (!(found.condition <= largest_condition))
    return false;
  const Eigen::MatrixXcd vectors = scale.cwiseInverse().asDiagonal() * found.vectors,
                         inverse = found.inverse * scale.asDiagonal();
  std::vector<Index> pairs, reals;
  for (Index k = 0; k < found.values.size(); ++k)
    if (found.values(k).imag() != 0.0)
      pairs.push_back(k++);
    else
      reals.push_back(k);
  Block b;
  b.modes = of.modes;
  b.count = {padded(pairs.size()), padded(reals.size())};
  b.first = size_;
  b.rows = padded(2 * of.modes.size());
  b.values.assign(static_cast<std::size_t>(b.width()), 0.0);
  b.start = MatrixXd::Zero(b.width(), 2 * m);
  MatrixXd state = MatrixXd::Zero(scale.size(), b.width()); // X of y
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    const auto re = static_cast<Index>(p), im = re + b.count.pairs;
    b.values[p] = found.values(pairs[p]);
    b.start.row(re) = inverse.row(pairs[p]).head(2 * m).real();
    b.start.row(im) = inverse.row(pairs[p]).head(2 * m).imag();
    state.col(re) = 2.0 * vectors.col(pairs[p]).real();
    state.col(im) = -2.0 * vectors.col(pairs[p]).imag();
  }
  for (std::size_t p = 0; p < reals.size(); ++p) {
    const auto at = static_cast<Index>(p) + 2 * b.count.pairs;
    b.values[static_cast<std::size_t>(at)] = found.values(reals[p]);
    b.start.row(at) = inverse.row(reals[p]).head(2 * m).real();
    state.col(at) = vectors.col(reals[p]).real();
  }
  const core::MotionForces& f = system.motion;
  MatrixXd forces(m, scale.size());
  forces << f.stiffness(of.modes, of.modes), f.damping(of.modes, of.modes), f.input(of.modes, of.states);
  b.forces = forces * state;
  b.top = in_tiles(state.topRows(2 * m), b.rows);
  b.input = in_tiles(b.start.rightCols(m), b.width());
  for (const int length : lengths) {
    b.decay.emplace_back(static_cast<std::size_t>(b.width()), 0.0);
    b.answers.emplace_back(static_cast<std::size_t>(2 * b.width()), 0.0);
    set_times(b, length * step, b.decay.back().data(), b.answers.back().data());
  }
  b.load.assign(of.modes.size(), 0.0);
  b.load_input.assign(static_cast<std::size_t>(b.width()), 0.0);
  b.y = b.load_input;
  b.qv.assign(static_cast<std::size_t>(b.rows), 0.0);
  size_ += static_cast<std::size_t>(b.width());
  blocks_.push_back(std::move(b));
  return true;
}

/// What forces of value 1 on the modes, and on the contacts, make of the block in a step.
void DiagonalFlow::add_rows(const Scene& scene, Block& b, double step) {
  const auto m = static_cast<Index>(b.modes.size()), width = static_cast<Index>(b.width());
  kernels::Array answer(static_cast<std::size_t>(2 * width), 0.0), decay(answer), y,
      g(static_cast<std::size_t>(width)), less(g);
  set_times(b, step, decay.data(), answer.data());
  const auto moved_by = [&](const kernels::Array& early, const kernels::Array& late, double* qv) {
    y.assign(g.size(), 0.0);
    kernels::load_states(b.count, answer.data(), early.data(), late.data(), y.data());
    kernels::multiply(b.rows, b.width(), b.top.data(), y.data(), qv);
  };
  kernels::Array qv(static_cast<std::size_t>(b.rows));
  MatrixXd constant(b.rows, m);
  for (Index j = 0; j < m; ++j) {
    Eigen::Map<VectorXd>(g.data(), width) = b.start.col(m + j);
    moved_by(g, g, qv.data());
    constant.col(j) = Eigen::Map<VectorXd>(qv.data(), b.rows);
  }
  b.constant = in_tiles(constant, b.rows);
  b.row_places.assign(3 * scene.contacts.size(), -1);
  int count = 0;
  for (std::size_t c = 0; c < scene.contacts.size(); ++c) {
    const MatrixXd over_block = scene.contacts[c].over_all(scene.system.size())(Eigen::all, b.modes);
    for (std::size_t component = 0; component < 3; ++component) {
      const Eigen::RowVectorXd row = over_block.row(static_cast<Index>((component + 1) % 3)); // y z x
      if (row.isZero(0.0))
        continue;
      b.row_places[3 * c + component] = count++;
      b.of_rows.resize(static_cast<std::size_t>(count) * b.row_size());
      double* to = &b.of_rows[b.of_rows.size() - b.row_size()];
      Eigen::Map<VectorXd>(g.data(), width) = b.start.rightCols(m) * row.transpose();
      std::transform(g.begin(), g.end(), less.begin(), [](double x) { return -x; });
      std::copy(g.begin(), g.end(), to);
      moved_by(g, g, to + width);
      moved_by(less, g, to + width + b.rows);
    }
  }
}

/// e^(l t), and what y gains by the load's input at the start and at the end.
void DiagonalFlow::set_times(const Block& b, double t, double* decay, double* answer) const {
  const auto pairs = static_cast<std::size_t>(b.count.pairs), width = static_cast<std::size_t>(b.width());
  for (std::size_t k = 0; k < width; k = k + 1 == pairs ? 2 * pairs : k + 1) {
    const Complex x = b.values[k] * t, e = std::exp(x);
    const auto [one, two] = phi(x);
    const Complex early = t * (one - two), late = t * two;
    decay[k] = e.real();
    answer[k] = early.real();
    answer[width + k] = late.real();
    if (k >= pairs)
      continue;
    decay[pairs + k] = e.imag();
    answer[pairs + k] = early.imag();
    answer[width + pairs + k] = late.imag();
  }
}

const double* DiagonalFlow::part(const Block& b, const double* all, kernels::Array& to) const {
  for (std::size_t i = 0; i < b.modes.size(); ++i)
    to[i] = all[b.modes[i]];
  return to.data();
}

void DiagonalFlow::give(const Block& b, const double* qv, double* q, double* v) {
  for (std::size_t i = 0, m = b.modes.size(); i < m; ++i) {
    q[b.modes[i]] = qv[i];
    v[b.modes[i]] = qv[m + i];
  }
}

void DiagonalFlow::start(const double* q, const double* v, double* y) const {
  for (const Block& b : blocks_) {
    const auto m = static_cast<Index>(b.modes.size());
    Eigen::Map<VectorXd> to(y + b.first, b.width());
    to.setZero();
    for (Index i = 0; i < m; ++i) {
      const Index mode = b.modes[static_cast<std::size_t>(i)];
      to += q[mode] * b.start.col(i) + v[mode] * b.start.col(m + i);
    }
  }
}

/// Adds what the loads make of y; the input of load1 stays for the step after it.
void DiagonalFlow::load_block(Block& b, std::size_t place, const double* load0, const double* load1) {
  const int m = static_cast<int>(b.modes.size());
  const auto input = [&](const double* load, kernels::Array& to) {
    (void)part(b, load, a_);
    if (!std::equal(b.load.begin(), b.load.end(), a_.begin())) {
      std::copy_n(a_.begin(), b.load.size(), b.load.begin());
      kernels::multiply(b.width(), m, b.input.data(), a_.data(), b.load_input.data());
    }
    std::copy(b.load_input.begin(), b.load_input.end(), to.begin());
  };
  input(load0, g0_);
  input(load1, g1_);
  kernels::load_states(b.count, b.answers[place].data(), g0_.data(), g1_.data(), b.y.data());
}

void DiagonalFlow::move(std::size_t place, const double* y0, const double* load0, const double* load1,
                        double* y, double* q, double* v) {
  for (Block& b : blocks_) {
    std::copy_n(y0 + b.first, b.y.size(), b.y.begin());
    kernels::decay_states(b.count, b.decay[place].data(), b.y.data());
    if (load0)
      load_block(b, place, load0, load1);
    kernels::multiply(b.rows, b.width(), b.top.data(), b.y.data(), b.qv.data());
    std::copy(b.y.begin(), b.y.end(), y + b.first);
    give(b, b.qv.data(), q, v);
  }
}

void DiagonalFlow::push(const RowForces& forces, double* y, double* q, double* v) {
  for (Block& b : blocks_) {
    int count = 0;
    const auto width = static_cast<std::size_t>(b.width()), rows = static_cast<std::size_t>(b.rows);
    for (std::size_t k = 0; k < forces.count; ++k) {
      const int place = b.row_places[static_cast<std::size_t>(forces.rows[k])];
      if (place < 0)
        continue;
      const double* row = &b.of_rows[static_cast<std::size_t>(place) * b.row_size()];
      const double mean = forces.mean[k], slope = forces.slope ? forces.slope[k] : 0.0;
      const auto at = static_cast<std::size_t>(count++);
      parts_[0][at] = row;
      parts_[1][at] = row + width;
      parts_[2][at] = row + width + rows;
      factors_[0][at] = mean - slope;
      factors_[1][at] = mean + slope;
      factors_[2][at] = mean;
      factors_[3][at] = slope;
    }
    std::copy(b.y.begin(), b.y.end(), y + b.first);
    if (count == 0) {
      give(b, b.qv.data(), q, v);
      continue;
    }
    std::copy(b.qv.begin(), b.qv.end(), moved_.begin());
    kernels::scatter(b.rows, count, parts_[1].data(), factors_[2].data(), moved_.data());
    kernels::scatter(b.rows, count, parts_[2].data(), factors_[3].data(), moved_.data());
    give(b, moved_.data(), q, v);
    std::fill_n(g0_.begin(), width, 0.0);
    std::fill_n(g1_.begin(), width, 0.0);
    kernels::scatter(b.width(), count, parts_[0].data(), factors_[0].data(), g0_.data());
    kernels::scatter(b.width(), count, parts_[0].data(), factors_[1].data(), g1_.data());
    kernels::load_states(b.count, b.answers.back().data(), g0_.data(), g1_.data(), y + b.first);
  }
}

void DiagonalFlow::response(const double* force, double* moved) {
  for (Block& b : blocks_) {
    kernels::multiply(b.rows, static_cast<int>(b.modes.size()), b.constant.data(), part(b, force, a_),
                      moved_.data());
    for (std::size_t i = 0; i < b.modes.size(); ++i)
      moved[b.modes[i]] = moved_[i];
  }
}

void DiagonalFlow::inside(double t, const double* y0, const double* f0, const double* slope, double* q,
                          double* v) {
  for (const Block& b : blocks_) {
    const int m = static_cast<int>(b.modes.size());
    set_times(b, t, decay_.data(), answer_.data());
    (void)part(b, f0, a_);
    (void)part(b, slope, b_);
    for (std::size_t i = 0; i < b.modes.size(); ++i)
      b_[i] = a_[i] + t * b_[i];
    kernels::multiply(b.width(), m, b.input.data(), a_.data(), g0_.data());
    kernels::multiply(b.width(), m, b.input.data(), b_.data(), g1_.data());
    double* y = inside_.data() + b.first;
    std::copy_n(y0 + b.first, b.y.size(), y);
    kernels::decay_states(b.count, decay_.data(), y);
    kernels::load_states(b.count, answer_.data(), g0_.data(), g1_.data(), y);
    kernels::multiply(b.rows, b.width(), b.top.data(), y, moved_.data());
    give(b, moved_.data(), q, v);
  }
}

void DiagonalFlow::add_forces(double* force) const {
  for (const Block& b : blocks_) {
    const Eigen::Map<const VectorXd> y(inside_.data() + b.first, b.width());
    for (std::size_t i = 0; i < b.modes.size(); ++i)
      force[b.modes[i]] += b.forces.row(static_cast<Index>(i)).dot(y);
  }
}

} // namespace fretwork::transient
