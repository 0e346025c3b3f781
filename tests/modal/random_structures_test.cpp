// SPDX-License-Identifier: GPL-3.0-or-later
// Two hundred structures made by chance, as the parts of one model: no mode is missed, and any number of ranks
// gives the same bytes.
#include "../fem/model_builder.hpp"
#include "core/mpi.hpp"
#include "fem/rigid_motions.hpp"
#include "modal/finish.hpp"
#include "modal/slepc_structures.hpp"
#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <random>

namespace random_structures_test {

using namespace fretwork;
using namespace fretwork::tests;

namespace {

constexpr int structures_made = 200;
constexpr double same_frequency = 1e-9; // strain energies of shapes that two solvers give to 1e-7

class Chance {
public:
  explicit Chance(unsigned seed) : generator_(seed) {}
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator_);
  }
  int one_of(int count) { return std::uniform_int_distribution<int>(0, count - 1)(generator_); }
  bool once_in(int count) { return one_of(count) == 0; }
  Vec3 vector() { return {between(-1, 1), between(-1, 1), between(-1, 1)}; }
  Eigen::Matrix3d rotation() {
    return Eigen::Quaterniond(between(-1, 1), between(-1, 1), between(-1, 1), between(-1, 1))
        .normalized()
        .toRotationMatrix();
  }

private:
  std::mt19937 generator_;
};

/// A tube of n elements of unequal lengths from a to b; the nodes.
std::vector<Index> jittered(ModelBuilder& b, Chance& chance, const Vec3& from, const Vec3& to, int n,
                            Index property, Index start = -1) {
  std::vector<Vec3> points;
  for (int i = start < 0 ? 0 : 1; i <= n; ++i)
    points.push_back(from + (to - from) * ((i + (i % n ? chance.between(-0.3, 0.3) : 0.0)) / n));
  return b.chain(points, property, start);
}

void hold(ModelBuilder& b, Chance& chance, Index node) {
  constexpr std::array<unsigned, 5> ways{0, all, ux | uy | uz, uy | uz, ux | ry};
  b.fix(node, ways[static_cast<std::size_t>(chance.one_of(5))]);
}

void load_with_bodies(ModelBuilder& b, Chance& chance, const std::vector<Index>& nodes) {
  const auto any = [&] {
    return nodes[static_cast<std::size_t>(chance.one_of(static_cast<int>(nodes.size())))];
  };
  if (chance.once_in(2))
    b.model.masses.push_back({any(), chance.between(0.1, 20), Vec3(1, 2, 3) * chance.between(0, 0.1),
                              chance.once_in(2) ? Vec3::Zero() : Vec3(0.1 * chance.vector())});
  if (chance.once_in(2)) {
    const double k = std::pow(10.0, chance.between(2, 7));
    b.model.springs.push_back({any(), -1, {k, 0.5 * k, 0.0, chance.once_in(2) ? k : 0.0, 0.0, 0.0}, {}});
  }
}

/// One span, repeated tubes joined by dampers, a star of equal arms, or a closed ring.
void add_structure(ModelBuilder& b, unsigned seed, const Vec3& place) {
  Chance chance(seed);
  fem::BeamProperty p = tube_property();
  if (chance.once_in(3)) {
    p.section = fem::rectangle_section(0.02, 0.013);
    p.orientation = chance.vector();
  }
  const Index property = b.property(p);
  const Eigen::Matrix3d turn = chance.rotation();
  const int kind = chance.one_of(4);
  std::vector<Index> nodes;
  if (kind == 0) {
    nodes = jittered(b, chance, place, place + turn * Vec3(chance.between(0.5, 3), 0, 0),
                     12 + chance.one_of(12), property);
    hold(b, chance, nodes.front());
    hold(b, chance, nodes.back());
    hold(b, chance, nodes[nodes.size() / 2]);
  } else if (kind == 1) {
    const int tubes = 2 + chance.one_of(3);
    Index last = -1;
    for (int i = 0; i < tubes; ++i) {
      const Vec3 foot = place + turn * Vec3(0, 0.1 * i, 0);
      const auto tube = b.line(foot, foot + turn * Vec3(1, 0, 0), 8, property);
      b.fix(tube.front(), all);
      if (last >= 0)
        b.model.springs.push_back({last, tube[1], {}, {0.0, 1e-3}});
      last = tube[1];
    }
    return;
  } else if (kind == 2) {
    const Index centre = b.node(place);
    const int arms = 3 + chance.one_of(3);
    for (int arm = 0; arm < arms; ++arm) {
      const double angle = 2 * std::numbers::pi * arm / arms;
      const auto tips =
          b.line_from(centre, place + turn * Vec3(std::cos(angle), std::sin(angle), 0), 5, property);
      if (seed % 2)
        b.fix(tips.back(), ux | uy | uz);
    }
    nodes = {centre};
  } else {
    const int around = 16 + chance.one_of(8);
    nodes = {b.node(place + turn * Vec3(1, 0, 0))};
    nodes = b.arc_from(nodes.front(), place, turn * Vec3::UnitX(), turn * Vec3::UnitY(), 0.0,
                       2 * std::numbers::pi * (around - 1) / around, around - 1, property);
    b.model.beams.push_back({nodes.back(), nodes.front(), property});
    hold(b, chance, nodes.front());
  }
  load_with_bodies(b, chance, nodes);
}

const fem::Model& two_hundred() {
  static const fem::Model model = [] {
    ModelBuilder b;
    for (unsigned i = 0; i < structures_made; ++i)
      add_structure(b, 1 + i, {10.0 * i, 0, 0});
    return b.model;
  }();
  return model;
}

modal::Wanted iterated(int count) {
  modal::Wanted wanted{count, std::nullopt};
  wanted.dense_up_to = 20;
  return wanted;
}

modal::Basis densely(const fem::Model& model, const fem::Structure& part, int count) {
  const Eigen::MatrixXd rigid = fem::rigid_motions(model, part);
  modal::Cut cut;
  cut.count = count;
  return modal::finish(model, part, rigid, modal::dense_modes(model, part, rigid), cut);
}

} // namespace

TEST(RandomStructures, MissNoModeOfADenseSolve) {
  const auto parts = fem::structures(two_hundred());
  ASSERT_EQ(parts.size(), std::size_t{structures_made});
  const auto ranks = static_cast<std::size_t>(core::size(MPI_COMM_WORLD));
  for (auto s = static_cast<std::size_t>(core::rank(MPI_COMM_WORLD)); s < parts.size(); s += ranks) {
    const int count = 6 + static_cast<int>(s % 10);
    const auto found = modal::solve_modes(MPI_COMM_SELF, two_hundred(), parts[s], iterated(count));
    const auto reference = densely(two_hundred(), parts[s], count);
    ASSERT_EQ(found.size(), count) << s;
    for (Eigen::Index i = 0; i < count; ++i)
      EXPECT_NEAR(found.omega[i], reference.omega[i], same_frequency * reference.omega[i])
          << "structure " << s << " mode " << i;
    EXPECT_LT(found.orthogonality, 1e-13) << s;
  }
}

TEST(RandomStructures, AreTheSameBytesForAnyNumberOfRanks) {
  const auto parts = fem::structures(two_hundred());
  const auto shared = modal::solve_structures(MPI_COMM_WORLD, two_hundred(), parts, iterated(12));
  const auto ranks = static_cast<std::size_t>(core::size(MPI_COMM_WORLD));
  for (auto s = static_cast<std::size_t>(core::rank(MPI_COMM_WORLD)) + 1; s < parts.size(); s += 3 * ranks) {
    const auto alone = modal::solve_modes(MPI_COMM_SELF, two_hundred(), parts[s], iterated(12));
    EXPECT_EQ(shared[s].nodes, alone.nodes);
    EXPECT_TRUE(shared[s].shapes == alone.shapes) << s;
    EXPECT_TRUE(shared[s].omega == alone.omega) << s;
    EXPECT_TRUE(shared[s].error == alone.error) << s;
    EXPECT_TRUE(shared[s].participation == alone.participation) << s;
  }
}

} // namespace random_structures_test
