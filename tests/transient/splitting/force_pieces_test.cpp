// SPDX-License-Identifier: GPL-3.0-or-later
// The pieces of force within the steps of splitting against what the states of contacts say of whole steps.
#include "scenes.hpp"
#include <algorithm>
#include <gtest/gtest.h>
#include <vector>

namespace force_pieces_test {

using namespace fretwork;
using namespace fretwork::tests;
using namespace fretwork::transient;

namespace {

class Pieces final : public Observer {
public:
  explicit Pieces(const Scene& scene) : contacts_(scene.contacts) {}
  void visit(core::StateArchive&) override {}
  void step(const Record& record) override {
    struct Sum {
      double normal = 0.0, friction = 0.0, peak = 0.0, end = 0.0;
    };
    std::vector<Sum> sums(contacts_.size());
    for (const ForcePiece& p : record.pieces) {
      Sum& s = sums.at(static_cast<std::size_t>(p.contact));
      EXPECT_GE(p.from, s.end - 1e-12);
      EXPECT_GT(p.to, p.from);
      EXPECT_LE(p.to, 1.0 + 1e-12);
      s.end = p.to;
      s.normal += (p.to - p.from) * p.normal.mean;
      s.friction += (p.to - p.from) * p.friction.mean;
      s.peak = std::max(s.peak, p.normal.largest());
      const double mu = contacts_[static_cast<std::size_t>(p.contact)].support.friction.mu_static;
      EXPECT_LE(p.friction.first, mu * p.normal.first * (1.0 + 1e-12));
      EXPECT_LE(p.friction.last, mu * p.normal.last * (1.0 + 1e-12));
      EXPECT_GE(std::min(p.friction.first, p.friction.last), 0.0);
    }
    std::vector<char> active(contacts_.size());
    for (const int c : record.active)
      active[static_cast<std::size_t>(c)] = 1;
    for (std::size_t c = 0; c < sums.size(); ++c) {
      const ContactState& state = record.states[c];
      EXPECT_EQ(sums[c].end > 0.0, active[c] != 0);
      if (active[c] == 0)
        continue;
      ++seen;
      EXPECT_NEAR(sums[c].normal, state.normal_force, 1e-12 * state.peak);
      EXPECT_EQ(sums[c].peak, state.peak);
      EXPECT_GE(sums[c].friction, norm(state.friction) - 1e-12 * state.peak);
    }
  }
  int seen = 0;

private:
  const std::vector<ContactPoint>& contacts_;
};

void expect_pieces_of_states(const Scene& scene, double step) {
  StepOptions options;
  options.scheme = SchemeKind::splitting;
  options.step = step;
  Pieces pieces(scene);
  Observer* const observers[] = {&pieces};
  EXPECT_EQ(run(scene, choose_step(scene, options), observers, nullptr, {}).outcome, Outcome::done);
  EXPECT_GT(pieces.seen, 100);
}

} // namespace

TEST(ForcePieces, AddUpToTheForcesOfSteps) {
  expect_pieces_of_states(rattling(5, 20, 0.3), 2e-4);
  expect_pieces_of_states(rattling(5, 20, 0.3), 1e-3);
}

TEST(ForcePieces, AddUpWhereTheForcesOfAStepAreFoundAgain) {
  expect_pieces_of_states(turning_bar(1.0), 2e-4);
}

TEST(ForcePieces, AddUpWithTheReferenceMemory) {
  Scene scene = rattling(5, 20, 0.3);
  for (ContactPoint& contact : scene.contacts)
    contact.support.friction.kind = contact::FrictionMemoryKind::reference;
  expect_pieces_of_states(scene, 2e-4);
}

} // namespace force_pieces_test
