// SPDX-License-Identifier: GPL-3.0-or-later
#include "vibration/diagonal_flow.hpp"
#include "core/general_eigenvalues.hpp"
#include "vibration/oscillator.hpp"
#include <algorithm>
#include <array>
#include <cmath>

namespace fretwork::vibration {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double largest_condition = 1e6, largest_form = 1e6;
constexpr double negligible_participation = 1e-12; ///< of what a velocity makes of scaled q and v
constexpr double round_off = 1e-14;                ///< of a power
/// Blocks of fewer modes are put together: a pack of displacements and velocities takes no longer than one of them.
constexpr std::size_t modes_of_pack = kernels::lanes / 2;

int padded(std::size_t n) { return kernels::padded(static_cast<int>(n)); }

/// phi_0 to phi_4; the series where the closed forms would cancel.
std::array<Complex, 5> phi(Complex x) {
  constexpr std::array<double, 5> first = {1.0, 1.0, 1.0 / 2.0, 1.0 / 6.0, 1.0 / 24.0}; // 1/k!
  std::array<Complex, 5> out{std::exp(x)};
  if (std::abs(x) > 1.0) {
    for (std::size_t k = 0; k < 4; ++k)
      out[k + 1] = (out[k] - first[k]) / x;
    return out;
  }
  Complex term = first[4]; // x^j/(j+4)!
  for (int j = 0; j < 18; ++j) {
    out[4] += term;
    term *= x / (j + 5.0);
  }
  for (std::size_t k = 4; k-- > 1;)
    out[k] = first[k] + x * out[k + 1];
  return out;
}

/// Of forces by Legendre's polynomials of degree 0 to 3 y takes, over t, phi_1, 2 phi_2 - phi_1, phi_1 - 6 phi_2 + 12 phi_3 and
/// 120 phi_4 - 60 phi_3 + 12 phi_2 - phi_1 times them. Real shares of the first two, which are the same for the conjugate coordinate.
std::array<LinearForce, 2> linear_for_bends_of(Complex l, double t) {
  if (!(std::abs(l) * t < highest_followed))
    return {};
  const std::array<Complex, 5> f = phi(l * t);
  const Complex slope = 2.0 * f[2] / f[1] - 1.0;
  const auto linear = [&](Complex taken) {
    const Complex of = taken / f[1];
    const double by_slope = l.imag() != 0.0 ? of.imag() / slope.imag() : 0.0;
    return LinearForce{of.real() - by_slope * slope.real(), by_slope};
  };
  return {linear(f[1] - 6.0 * f[2] + 12.0 * f[3]), linear(120.0 * f[4] - 60.0 * f[3] + 12.0 * f[2] - f[1])};
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

/// How y of the places of a block (pairs, then real ones) stand for complex coordinates, those of a pair and of its conjugate: coordinate by coordinate
/// the places and their factors.
struct Coordinate {
  Index column; ///< of the eigenvectors
  std::array<Index, 2> places;
  std::array<Complex, 2> factors;
};

/// P by places.   @return empty: an element is too large
MatrixXd work_form(const core::Diagonalised& found, const std::vector<Coordinate>& coordinates, Index width,
                   const MatrixXcd& velocities, const MatrixXcd& forces) {
  MatrixXcd powers = velocities.transpose() * forces;
  powers += powers.transpose().eval();
  MatrixXd out = MatrixXd::Zero(width, width);
  for (const Coordinate& a : coordinates)
    for (const Coordinate& b : coordinates) {
      const Complex power = 0.5 * powers(a.column, b.column);
      const Complex la = found.values(a.column), lb = found.values(b.column);
      if (std::abs(power) <= round_off * (std::abs(la) + std::abs(lb)))
        continue;
      const Complex p = -power / (la + lb);
      if (!(std::abs(p) <= largest_form))
        return {};
      for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t j = 0; j < 2; ++j)
          out(a.places[i], b.places[j]) += (a.factors[i] * b.factors[j] * p).real();
    }
  return out;
}

} // namespace

DiagonalFlow::DiagonalFlow(const System& system, const std::vector<CoupledBlock>& blocks, double step,
                           const std::vector<int>& lengths)
    : step_(step) {
  for (const CoupledBlock& block : put_together(blocks))
    add_block(system, block, step, lengths);
  std::size_t width = 0, modes = 0;
  for (const Block& b : blocks_) {
    width = std::max(width, static_cast<std::size_t>(b.width()));
    modes = std::max(modes, static_cast<std::size_t>(b.rows()));
  }
  modes_.assign(modes, 0.0);
  moved_.assign(std::max(modes, kernels::numbers_of_input * width), 0.0);
  table_.assign(kernels::StateTable::numbers * width, 0.0);
}

void DiagonalFlow::add_block(const System& system, const CoupledBlock& of, double step,
                             const std::vector<int>& lengths) {
  const auto m = static_cast<Index>(of.modes.size());
  const VectorXd scale = scales(system, of);
  const core::Diagonalised found =
      core::diagonalised(scale.asDiagonal() * state_matrix(system, of) * scale.cwiseInverse().asDiagonal());
  if (!(found.condition <= largest_condition))
    return;
  const MatrixXcd vectors = scale.cwiseInverse().asDiagonal() * found.vectors,
                  inverse = found.inverse * scale.asDiagonal();
  std::vector<Index> pairs, reals;
  for (Index k = 0; k < found.values.size(); ++k) {
    const bool pair = found.values(k).imag() != 0.0;
    if (found.vectors.col(k).head(2 * m).norm() * found.inverse.row(k).head(2 * m).norm() >
        negligible_participation)
      (pair ? pairs : reals).push_back(k);
    k += pair ? 1 : 0;
  }
  Block b;
  b.modes = of.modes;
  b.count = {padded(pairs.size()), padded(reals.size())};
  b.first = size_;
  b.stiffness = system.stiffness(of.modes);
  b.values.assign(static_cast<std::size_t>(b.width()), 0.0);
  const Index width = b.width();
  b.start = MatrixXd::Zero(width, 2 * m);
  MatrixXd state = MatrixXd::Zero(scale.size(), width); // X of y
  std::vector<Coordinate> coordinates;
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    const auto re = static_cast<Index>(p), im = re + b.count.pairs;
    b.values[p] = found.values(pairs[p]);
    b.start.row(re) = inverse.row(pairs[p]).head(2 * m).real();
    b.start.row(im) = inverse.row(pairs[p]).head(2 * m).imag();
    state.col(re) = 2.0 * vectors.col(pairs[p]).real();
    state.col(im) = -2.0 * vectors.col(pairs[p]).imag();
    coordinates.push_back({pairs[p], {re, im}, {1.0, Complex(0.0, 1.0)}});
    coordinates.push_back({pairs[p] + 1, {re, im}, {1.0, Complex(0.0, -1.0)}});
  }
  for (std::size_t p = 0; p < reals.size(); ++p) {
    const auto at = static_cast<Index>(p) + 2 * b.count.pairs;
    b.values[static_cast<std::size_t>(at)] = found.values(reals[p]);
    b.start.row(at) = inverse.row(reals[p]).head(2 * m).real();
    state.col(at) = vectors.col(reals[p]).real();
    coordinates.push_back({reals[p], {at, at}, {1.0, 0.0}});
  }
  const core::MotionForces& f = system.motion;
  MatrixXd forces(m, scale.size());
  forces << f.stiffness(of.modes, of.modes), f.damping(of.modes, of.modes), f.input(of.modes, of.states);
  const MatrixXd form =
      work_form(found, coordinates, width, vectors.middleRows(m, m), forces.cast<Complex>() * vectors);
  if (form.size() == 0)
    return;
  b.forces = forces * state;
  b.state = state.topRows(2 * m);
  b.input.resize(kernels::numbers_of_input * width, m);
  b.input << b.start.rightCols(m), b.state.bottomRows(m).transpose(), 2.0 * form * b.start.rightCols(m);
  b.top = in_tiles(b.state, b.rows());
  b.input_tiles = in_tiles(b.input, static_cast<int>(b.input.rows()));
  b.form = in_tiles(form, b.width());
  const auto table_of = [&](double t) {
    kernels::Array table(static_cast<std::size_t>(kernels::StateTable::numbers * width), 0.0);
    set_table(b, t, table.data());
    return table;
  };
  for (const int length : lengths) {
    b.tables.push_back(table_of(length * step));
    b.halves.push_back(table_of(0.5 * length * step));
  }
  b.bow = table_of(step);
  set_bow(b, step, b.bow.data());
  const kernels::Array one_step = table_of(step);
  const auto constant = [&](const VectorXd& input) {
    const kernels::Array none(static_cast<std::size_t>(width), 0.0), g = kernels::padded_copy(input);
    kernels::Array y(none), rate(none);
    kernels::move_states(b.count, one_step.data(), none.data(),
                         {none.data(), none.data(), g.data(), none.data()}, y.data(), rate.data());
    return VectorXd(Eigen::Map<VectorXd>(y.data(), width));
  };
  b.response.resize(2 * m, m);
  for (Index j = 0; j < m; ++j)
    b.response.col(j) = b.state * constant(b.start.col(m + j));
  size_ += static_cast<std::size_t>(width);
  blocks_.push_back(std::move(b));
}

/// Numbers of a table: write(l, set) for each eigenvalue l, set(number, value).
template <class Write> void DiagonalFlow::write_numbers(const Block& b, double* table, const Write& write) {
  const auto pairs = static_cast<std::size_t>(b.count.pairs), width = static_cast<std::size_t>(b.width());
  for (std::size_t i = 0; i < width; i = i + 1 == pairs ? 2 * pairs : i + 1)
    write(b.values[i], [&](kernels::StateTable::Number number, Complex x) {
      double* to = table + static_cast<std::size_t>(number) * width + i;
      *to = x.real();
      if (i < pairs)
        to[pairs] = x.imag();
    });
}

void DiagonalFlow::set_table(const Block& b, double t, double* table) {
  using Table = kernels::StateTable;
  write_numbers(b, table, [&](Complex l, const auto& set) {
    const std::array<Complex, 5> f = phi(l * t);
    set(Table::e, f[0]);
    set(Table::a0, t * (f[1] - f[2]));
    set(Table::a1, t * f[2]);
    set(Table::l, l);
    set(Table::p, t * f[2]);
    set(Table::p0, t * t * (f[3] - f[4]));
    set(Table::p1, t * t * f[4]);
    set(Table::r, t * (f[1] - f[2]));
    set(Table::r0, t * t * (f[2] - 2.0 * f[3] + f[4]));
    set(Table::r1, t * t * (f[3] - f[4]));
  });
}

/// Of a table for steps of this length: by how much the mean exceeds that of the cubic, (y0 + y1)/2 + t (l y0 - l y1)/12.
void DiagonalFlow::set_bow(const Block& b, double t, double* table) {
  using Table = kernels::StateTable;
  write_numbers(b, table, [&](Complex l, const auto& set) {
    const Complex z = l * t;
    const std::array<Complex, 5> f = phi(z);
    const Complex a0 = t * (f[1] - f[2]), a1 = t * f[2];
    set(Table::e, f[1] - 0.5 * (1.0 + f[0]) - z / 12.0 * (1.0 - f[0]));
    set(Table::a0, t * (f[2] - f[3]) - (0.5 - z / 12.0) * a0);
    set(Table::a1, t * f[3] - (0.5 - z / 12.0) * a1);
  });
}

void DiagonalFlow::linear_for_bends(BentForce& by, std::size_t first) const {
  for (const Block& b : blocks_) {
    const auto width = static_cast<std::size_t>(b.width()), pairs = static_cast<std::size_t>(b.count.pairs);
    for (std::size_t i = 0; i < width; ++i) {
      const std::array<LinearForce, 2> of =
          linear_for_bends_of(b.values[i >= pairs && i < 2 * pairs ? i - pairs : i], step_);
      for (std::size_t number = 0; number < kernels::numbers_of_input; ++number)
        for (std::size_t k = 0; k < by.size(); ++k) {
          const std::size_t at = first + kernels::numbers_of_input * b.first + number * width + i;
          by[k].mean[at] = of[k].mean;
          by[k].slope[at] = of[k].slope;
        }
    }
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

void DiagonalFlow::add_input(const double* force, double* input) {
  for (const Block& b : blocks_) {
    for (std::size_t i = 0; i < b.modes.size(); ++i)
      modes_[i] = force[b.modes[i]];
    const int rows = kernels::numbers_of_input * b.width();
    kernels::multiply(rows, static_cast<int>(b.modes.size()), b.input_tiles.data(), modes_.data(),
                      moved_.data());
    double* to = input + kernels::numbers_of_input * b.first;
    for (int i = 0; i < rows; ++i)
      to[i] += moved_[static_cast<std::size_t>(i)];
  }
}

namespace {
/// Those of the block whose numbers of y begin at `first`.
kernels::StateInputs of_block(const kernels::StateInputs& inputs, std::size_t first) {
  const std::size_t at = kernels::numbers_of_input * first;
  return {inputs.load0 + at, inputs.load1 + at, inputs.mean + at, inputs.slope + at};
}
} // namespace

void DiagonalFlow::move(std::size_t place, const double* y0, const kernels::StateInputs& inputs, double* y,
                        double* rate) const {
  for (const Block& b : blocks_)
    kernels::move_states(b.count, b.tables[place].data(), y0 + b.first, of_block(inputs, b.first),
                         y + b.first, rate + b.first);
}

kernels::StateWorks DiagonalFlow::works(std::size_t place, const double* y0,
                                        const kernels::StateInputs& inputs) const {
  kernels::StateWorks sum;
  for (const Block& b : blocks_) {
    const kernels::StateWorks of =
        kernels::state_works(b.count, b.tables[place].data(), y0 + b.first, of_block(inputs, b.first));
    sum.load += of.load;
    sum.contact += of.contact;
    sum.fluid += of.fluid;
  }
  return sum;
}

/// q, then v.
const double* DiagonalFlow::modes_of_block(const Block& b, const double* y) {
  kernels::multiply(b.rows(), b.width(), b.top.data(), y + b.first, modes_.data());
  return modes_.data();
}

void DiagonalFlow::modes_of(const double* y, double* q, double* v) {
  for (const Block& b : blocks_) {
    const double* qv = modes_of_block(b, y);
    for (std::size_t i = 0, m = b.modes.size(); i < m; ++i) {
      q[b.modes[i]] = qv[i];
      v[b.modes[i]] = qv[m + i];
    }
  }
}

// In the middle of a load from load0 to load1 that is (load0 + load1)/2, the contact force `mean`: what a load of half the length comes to.
void DiagonalFlow::middle(std::size_t place, const double* y0, const kernels::StateInputs& inputs,
                          double* y) {
  for (const Block& b : blocks_) {
    const kernels::StateInputs of = of_block(inputs, b.first);
    const auto width = static_cast<std::size_t>(b.width());
    double *late = moved_.data(), *none = table_.data();
    for (std::size_t i = 0; i < width; ++i) { // without `mean`, which is added at both ends
      late[i] = 0.5 * (of.load0[i] + of.load1[i]);
      late[width + i] = of.load0[i] - of.slope[i];
    }
    std::fill_n(none, width, 0.0);
    kernels::move_states(b.count, b.halves[place].data(), y0 + b.first, {late + width, late, of.mean, none},
                         y + b.first, late + 2 * width);
  }
}

void DiagonalFlow::bow(const double* y0, const kernels::StateInputs& inputs, double* bow) {
  for (const Block& b : blocks_)
    kernels::move_states(b.count, b.bow.data(), y0 + b.first, of_block(inputs, b.first), bow + b.first,
                         moved_.data());
}

void DiagonalFlow::inside(double t, const double* y0, const kernels::StateInputs& inputs, double* y,
                          double* rate) {
  for (const Block& b : blocks_) {
    set_table(b, t, table_.data());
    kernels::move_states(b.count, table_.data(), y0 + b.first, of_block(inputs, b.first), y + b.first,
                         rate ? rate + b.first : moved_.data());
  }
}

double DiagonalFlow::energy(const double* y) {
  double twice = 0.0;
  for (const Block& b : blocks_) {
    const auto m = static_cast<Index>(b.modes.size());
    const Eigen::Map<const VectorXd> qv(modes_of_block(b, y), 2 * m);
    twice += qv.tail(m).squaredNorm() + qv.head(m).cwiseAbs2().dot(b.stiffness);
  }
  return 0.5 * twice;
}

double DiagonalFlow::fluid_form(const double* y) {
  double sum = 0.0;
  for (const Block& b : blocks_) {
    kernels::multiply(b.width(), b.width(), b.form.data(), y + b.first, moved_.data());
    sum += Eigen::Map<const VectorXd>(moved_.data(), b.width())
               .dot(Eigen::Map<const VectorXd>(y + b.first, b.width()));
  }
  return sum;
}

void DiagonalFlow::add_forces(const double* y, double* force) const {
  for (const Block& b : blocks_) {
    const Eigen::Map<const VectorXd> of(y + b.first, b.width());
    for (std::size_t i = 0; i < b.modes.size(); ++i)
      force[b.modes[i]] += b.forces.row(static_cast<Index>(i)).dot(of);
  }
}

void DiagonalFlow::response(const double* force, double* moved, double* velocity) const {
  for (const Block& b : blocks_) {
    VectorXd f(static_cast<Index>(b.modes.size()));
    for (std::size_t i = 0; i < b.modes.size(); ++i)
      f(static_cast<Index>(i)) = force[b.modes[i]];
    const VectorXd state = b.response * f;
    for (std::size_t i = 0; i < b.modes.size(); ++i) {
      moved[b.modes[i]] = state(static_cast<Index>(i));
      velocity[b.modes[i]] = state(static_cast<Index>(b.modes.size() + i));
    }
  }
}

} // namespace fretwork::vibration
