// SPDX-License-Identifier: GPL-3.0-or-later
// Exports for ParaView: which outputs they hold, frames and radii of the beams, what an earlier export left. What VTK reads of them:
// tests/app/paraview_test.py.
#include "core/error.hpp"
#include "folder.hpp"
#include "results/beam_fields.hpp"
#include "results/output_window.hpp"
#include "results/write.hpp"
#include "synthetic.hpp"
#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numbers>

namespace fretwork::results::export_vtu_test {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr double round_off = 1e-14;

/// 0, 0.1 ... 1 s
const Eigen::VectorXd tenths = Eigen::VectorXd::LinSpaced(11, 0.0, 1.0);

std::string refusal(const OutputWindow& window) {
  try {
    static_cast<void>(outputs_of(window, tenths));
  } catch (const core::Error& error) {
    return error.what();
  }
  return {};
}

TEST(OutputWindow, TakesBothEndsDespiteRounding) {
  EXPECT_THAT(outputs_of({.from = 0.3, .to = 0.6, .every = 1}, tenths), ElementsAre(3, 4, 5, 6));
  EXPECT_THAT(outputs_of({.from = 0.1 + 0.2, .to = 0.6 - 1e-13, .every = 1}, tenths),
              ElementsAre(3, 4, 5, 6));
  EXPECT_THAT(outputs_of({.from = 0.3001, .to = 0.5999, .every = 1}, tenths), ElementsAre(4, 5));
}

TEST(OutputWindow, TakesEveryNthFromTheFirstOn) {
  EXPECT_THAT(outputs_of({.every = 4}, tenths), ElementsAre(0, 4, 8));
  EXPECT_THAT(outputs_of({.from = 0.2, .every = 3}, tenths), ElementsAre(2, 5, 8));
  EXPECT_THAT(outputs_of({.every = 100}, tenths), ElementsAre(0));
  EXPECT_THAT(outputs_of({.every = std::numeric_limits<std::int64_t>::max()}, tenths), ElementsAre(0));
}

TEST(OutputWindow, SpreadsAsManyAsAreReadableOverALongSeries) {
  EXPECT_EQ(outputs_of({}, tenths).size(), 11u);
  const auto chosen = outputs_of({.from = 0.5}, Eigen::VectorXd::LinSpaced(2001, 0.0, 1.0));
  ASSERT_EQ(chosen.size(), static_cast<std::size_t>(most_snapshots));
  EXPECT_EQ(chosen.front(), 1000);
  EXPECT_EQ(chosen.back(), 2000);
  EXPECT_EQ(outputs_of({.every = 1}, Eigen::VectorXd::LinSpaced(2001, 0.0, 1.0)).size(), 2001u); // asked for
  EXPECT_THAT(outputs_of({.to = 0.0}, Eigen::VectorXd::Zero(1)), ElementsAre(0));
}

TEST(OutputWindow, RefusesWindowsWithoutOutputs) {
  EXPECT_THAT(refusal({.from = 1.5}), HasSubstr("--from 1.5: a time from 0 to 1 s is expected"));
  EXPECT_THAT(refusal({.to = -0.1}), HasSubstr("--to -0.1: a time from 0 to 1 s is expected"));
  EXPECT_THAT(refusal({.to = std::numeric_limits<double>::quiet_NaN()}), HasSubstr("--to nan"));
  EXPECT_THAT(refusal({.from = 0.6, .to = 0.3}), HasSubstr("ends before it begins"));
  EXPECT_THAT(refusal({.from = 0.31, .to = 0.32}),
              HasSubstr("no output lies between them; the next are at 0.3 and 0.4 s"));
  EXPECT_THAT(refusal({.every = -2}), HasSubstr("--every -2: an integer >= 1"));
}

TEST(ExportVtu, LeavesNothingOfAnEarlierOne) {
  const Folder folder;
  RunResults results = made_up({.outputs = 20, .elements = 4});
  EXPECT_EQ(export_vtu(folder.path(), results).count, 20);
  const VtuSeries second = export_vtu(folder.path(), results, {.every = 8});
  EXPECT_EQ(second.count, 3);
  EXPECT_EQ(second.outputs, 20);
  EXPECT_EQ(second.from, 0.0);
  EXPECT_EQ(second.to, results.series.time(16));
  double bytes = 0.0;
  for (const auto& file : fs::recursive_directory_iterator(folder.path()))
    bytes += file.is_regular_file() ? static_cast<double>(file.file_size()) : 0.0;
  EXPECT_EQ(second.bytes, bytes);
  for (const char* series : {"snapshots", "contacts"})
    EXPECT_EQ(std::distance(fs::directory_iterator(folder / series), {}), 3) << series;
  results.series.contacts.clear(); // left out of results.h5
  EXPECT_FALSE(export_vtu(folder.path(), results).contacts);
  EXPECT_FALSE(fs::exists(folder / "contacts.pvd"));
}

TEST(ExportVtu, NeedsSeriesOfTheModesForAWindow) {
  const Folder folder;
  RunResults results = made_up({.outputs = 20, .elements = 4});
  results.series.modal_displacement.resize(0, 0);
  EXPECT_EQ(export_vtu(folder.path(), results).count, 0);
  EXPECT_THAT([&] { export_vtu(folder.path(), results, {.from = 0.5}); },
              testing::ThrowsMessage<core::Error>(HasSubstr("without output.modal = false")));
}

/// Two legs of 1 m that meet at a right angle, a bend of four arcs after them, one section each.
RunResults bent() {
  RunResults results;
  results.nodes = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}};
  results.properties = {{{2e11, 0.3, 8000.0}, fem::pipe_section(0.02, 0.002)},
                        {{2e11, 0.3, 8000.0}, fem::circle_section(0.03)},
                        {{2e11, 0.3, 8000.0}, fem::rectangle_section(0.04, 0.04)}};
  results.beams = {{0, 1, 0}, {1, 2, 1}};
  for (int i = 1; i <= 4; ++i) {
    const auto at = [](double k) -> core::Vec3 {
      const double t = std::numbers::pi / 8.0 * k;
      return {0.5 + 0.5 * std::cos(t), 1.0 + 0.5 * std::sin(t), 0.0};
    };
    results.nodes.push_back(at(i));
    results.beams.push_back({core::Index(i + 1), core::Index(i + 2), 2, at(i - 0.5)});
  }
  for (const fem::Beam& beam : results.beams)
    results.lines.push_back({beam.a, beam.b});
  results.nodes.emplace_back(5.0, 5.0, 5.0); // alone
  return results;
}

TEST(BeamFields, HasOrthonormalFramesAlongTheTube) {
  const RunResults results = bent();
  const BeamFields fields(results);
  const auto orthonormal = [](const Frames& frames, Eigen::Index at) {
    Eigen::Matrix3d axes;
    axes << frames.x.col(at), frames.y.col(at), frames.z.col(at);
    EXPECT_LT((axes.transpose() * axes - Eigen::Matrix3d::Identity()).norm(), round_off) << at;
    EXPECT_NEAR(axes.determinant(), 1.0, round_off);
  };
  for (Eigen::Index i = 0; i < 6; ++i)
    orthonormal(fields.of_beams(), i);
  for (Eigen::Index i = 0; i < 7; ++i)
    orthonormal(fields.of_nodes(), i);
  const auto x = [&](Eigen::Index node) { return core::Vec3(fields.of_nodes().x.col(node)); };
  EXPECT_LT((x(0) - core::Vec3::UnitX()).norm(), round_off);
  EXPECT_LT((x(1) - core::Vec3(1, 1, 0).normalized()).norm(), round_off); // the mean of both legs
  for (int i = 0; i <= 4; ++i) { // the tangents of arcs that go on as each other
    const double t = std::numbers::pi / 8.0 * i;
    EXPECT_LT((x(i + 2) - core::Vec3(-std::sin(t), std::cos(t), 0.0)).norm(), round_off) << i;
  }
  EXPECT_TRUE(x(7).isZero(0.0));
}

TEST(BeamFields, TakesTheFirstFrameWhereBeamsTurnBack) {
  RunResults results = bent();
  results.nodes[2] = {0.0, 0.1, 0.0};
  const BeamFields fields(results);
  EXPECT_LT((fields.of_nodes().x.col(1) - core::Vec3::UnitX()).norm(), round_off);
}

TEST(BeamFields, HasOuterRadii) {
  const RunResults results = bent();
  const Eigen::RowVectorXd radius = BeamFields(results).radius();
  EXPECT_EQ(radius(0), 0.01);
  EXPECT_EQ(radius(1), 0.015);                                           // the larger one
  EXPECT_NEAR(radius(4), 0.04 / std::sqrt(std::numbers::pi), round_off); // as large as the square
  EXPECT_EQ(radius(7), 0.0);
}

TEST(BeamFields, GivesNoStressWhereTheOutlineIsNotKnown) {
  RunResults results = bent();
  results.properties[1].section.shape = std::monostate{};
  Motion motion = Motion::Zero(6, 8);
  motion(0, 0) = -1e-4; // the first leg gets longer
  const BeamFields::Forces forces = BeamFields(results).forces(motion);
  EXPECT_NEAR(forces.stress(0) / (2e11 * 1e-4), 1.0, round_off);
  EXPECT_NEAR(forces.middle(0, 0) / (2e11 * 1e-4 * results.properties[0].section.area), 1.0, round_off);
  EXPECT_TRUE(std::isnan(forces.stress(1)));
  EXPECT_EQ(forces.stress(2), 0.0);
}

} // namespace
} // namespace fretwork::results::export_vtu_test
