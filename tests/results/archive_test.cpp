// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/error.hpp"
#include "folder.hpp"
#include "results/basis_file.hpp"
#include "results/write.hpp"
#include "synthetic.hpp"
#include <chrono>
#include <cstring>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <thread>

namespace fretwork::results::archive_test {
namespace {

using testing::HasSubstr;

RunResults there_and_back(const RunResults& results) {
  const Folder folder;
  write_archive(folder / "results.h5", results);
  return read_archive(folder.path());
}

TEST(Archive, GivesBackEverySeriesBitForBit) {
  const RunResults out = made_up({.contacts = 4, .structures = 2}), in = there_and_back(out);
  EXPECT_EQ(in.series.time, out.series.time);
  EXPECT_EQ(in.series.modal_displacement, out.series.modal_displacement);
  EXPECT_EQ(in.series.modal_velocity, out.series.modal_velocity);
  ASSERT_EQ(in.series.contacts.size(), 4u);
  for (std::size_t c = 0; c < 4; ++c) {
    const post::ContactSeries &a = in.series.contacts[c], &b = out.series.contacts[c];
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.displacement, b.displacement);
    EXPECT_EQ(a.velocity, b.velocity);
    EXPECT_EQ(a.gap, b.gap);
    EXPECT_EQ(a.normal_force, b.normal_force);
    EXPECT_EQ(a.tangential_force, b.tangential_force);
    EXPECT_EQ(a.state, b.state);
    EXPECT_EQ(a.normal, b.normal);
  }
  ASSERT_EQ(in.series.nodes.size(), 1u);
  EXPECT_EQ(in.series.nodes[0].name, "apex");
  EXPECT_EQ(in.series.nodes[0].displacement, out.series.nodes[0].displacement);
  EXPECT_EQ(in.series.nodes[0].velocity, out.series.nodes[0].velocity);
  EXPECT_EQ(in.series.nodes[0].acceleration, out.series.nodes[0].acceleration);
}

TEST(Archive, GivesBackEveryImpact) {
  const RunResults out = made_up({.contacts = 3, .outputs = 400}), in = there_and_back(out);
  EXPECT_EQ(in.rest_time, out.rest_time);
  ASSERT_EQ(in.impacts.size(), 3u);
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_EQ(in.impacts[c].left_out, static_cast<std::int64_t>(c));
    ASSERT_GT(out.impacts[c].rows.size(), 3u);
    ASSERT_EQ(in.impacts[c].rows.size(), out.impacts[c].rows.size());
    for (std::size_t i = 0; i < in.impacts[c].rows.size(); ++i)
      EXPECT_EQ(std::memcmp(&in.impacts[c].rows[i], &out.impacts[c].rows[i], sizeof(post::Impact)),
                0); // NaN too
  }
}

TEST(Archive, HasNoTableOfImpactsWhereNoneWasKept) {
  RunResults out = made_up({.contacts = 2});
  out.impacts.clear();
  EXPECT_TRUE(there_and_back(out).impacts.empty());
  out = made_up({.contacts = 2});
  out.impacts[1].rows.clear(); // a contact without an impact has an empty one
  EXPECT_TRUE(there_and_back(out).impacts.at(1).rows.empty());
}

TEST(Archive, GivesBackTheModelAndTheRecord) {
  const RunResults out = made_up({.structures = 2}), in = there_and_back(out);
  EXPECT_EQ(in.nodes, out.nodes);
  EXPECT_EQ(in.lines, out.lines);
  EXPECT_EQ(in.groups, out.groups);
  EXPECT_EQ(in.model.nodes, out.model.nodes);
  EXPECT_EQ(in.model.elements, out.model.elements);
  EXPECT_EQ(in.model.dofs, out.model.dofs);
  EXPECT_EQ(in.model.mass_kg, out.model.mass_kg);
  EXPECT_EQ(in.record.version, out.record.version);
  EXPECT_EQ(in.record.title, out.record.title);
  EXPECT_EQ(in.record.study_text, out.record.study_text);
  EXPECT_EQ(in.record.input_sha256, out.record.input_sha256);
  EXPECT_EQ(in.record.seeds, out.record.seeds);
  EXPECT_EQ(in.record.libraries, out.record.libraries);
  EXPECT_EQ(in.duration, out.duration);
  EXPECT_EQ(in.statistics_from, out.statistics_from);
}

TEST(Archive, GivesBackWhatBeamsAreMadeOf) {
  RunResults out = made_up({.elements = 8});
  fem::BeamProperty bar{{2.1e11, 0.29, 7800.0}, fem::rectangle_section(0.03, 0.01)};
  bar.section.shear = fem::ShearCoefficients{0.8, 0.9};
  bar.orientation = core::Vec3(0.1, 1.0, 0.2);
  bar.axial_force = -120.0;
  fem::BeamProperty cone{{2.1e11, 0.29, 7800.0}, fem::circle_section(0.03)};
  cone.section.shear = fem::ShapeShear{};
  cone.section.rotary_inertia = true;
  cone.taper = fem::Taper{fem::circle_section(0.02)};
  fem::BeamProperty general = bar;
  general.section.shape = std::monostate{};
  out.properties.insert(out.properties.end(), {bar, cone, general});
  for (const std::size_t i : {std::size_t{1}, std::size_t{2}, std::size_t{3}})
    out.beams[i].property = static_cast<core::Index>(i);
  out.beams[2].along = {0.25, 0.75};
  out.beams[3].middle = core::Vec3(1.0, 0.5, 0.0);
  const RunResults in = there_and_back(out);
  EXPECT_EQ(in.properties, out.properties);
  EXPECT_EQ(in.beams, out.beams);
  out.beams.clear();
  EXPECT_TRUE(there_and_back(out).beams.empty());
}

TEST(Archive, GivesBackEveryContactAsItWasSetUp) {
  RunResults out = made_up();
  Eigen::Matrix<double, 3, 6> weights = Eigen::Matrix<double, 3, 6>::Random();
  out.contacts[1].point = {{1.0, 2.0, 3.0}, {{4, weights}, {5, -2.0 * weights}}};
  out.contacts[2].point.motion[0].node += 1; // the neighbour
  out.contacts[1].axes << 0.0, 0.6, 0.8, 1.0, 0.0, 0.0, 0.0, 0.8, -0.6;
  out.contacts[1].friction_static = 0.4;
  out.contacts[1].normal_damping = 7.0;
  out.contacts[1].tangential_stiffness = 2e6;
  out.contacts[1].normal_dissipation = 0.6;
  out.contacts[1].friction_along = {1.0, 0.0};
  out.contacts[1].other = 3;
  out.contacts[1].static_flexibility = {3e-7, 2e-7, 1e-7};
  out.contacts[2].outline = Eigen::MatrixXd::Random(5, 2);
  const RunResults in = there_and_back(out);
  ASSERT_EQ(in.contacts.size(), out.contacts.size());
  for (std::size_t c = 0; c < in.contacts.size(); ++c) {
    const ContactFacts &a = in.contacts[c], &b = out.contacts[c];
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.node, b.node);
    EXPECT_EQ(a.other, b.other);
    EXPECT_EQ(a.outline, b.outline);
    EXPECT_EQ(a.point.place, b.point.place);
    ASSERT_EQ(a.point.motion.size(), b.point.motion.size());
    for (std::size_t i = 0; i < a.point.motion.size(); ++i) {
      EXPECT_EQ(a.point.motion[i].node, b.point.motion[i].node);
      EXPECT_EQ(a.point.motion[i].weights, b.point.motion[i].weights);
    }
    EXPECT_EQ(a.normal_dissipation, b.normal_dissipation);
    EXPECT_EQ(a.friction_along, b.friction_along);
    ASSERT_EQ(a.static_flexibility.has_value(), b.static_flexibility.has_value());
    if (b.static_flexibility) {
      EXPECT_EQ(a.static_flexibility->exact, b.static_flexibility->exact);
      EXPECT_EQ(a.static_flexibility->basis, b.static_flexibility->basis);
      EXPECT_EQ(a.static_flexibility->missing, b.static_flexibility->missing);
    }
    EXPECT_EQ(a.axes, b.axes);
    EXPECT_EQ(a.obstacle, b.obstacle);
    EXPECT_EQ(a.gap, b.gap);
    EXPECT_EQ(a.rest, b.rest);
    EXPECT_EQ(a.normal_stiffness, b.normal_stiffness);
    EXPECT_EQ(a.normal_damping, b.normal_damping);
    EXPECT_EQ(a.tangential_stiffness, b.tangential_stiffness);
    EXPECT_EQ(a.tangential_damping, b.tangential_damping);
    EXPECT_EQ(a.friction_static, b.friction_static);
    EXPECT_EQ(a.friction_dynamic, b.friction_dynamic);
  }
}

TEST(Archive, KeepsTheOrderOfContactsAndNamesWithSlashes) {
  RunResults out = made_up({.contacts = 12});
  out.contacts[0].name = out.series.contacts[0].name = "z/first";
  out.contacts[1].name = out.series.contacts[1].name = "z%2Ffirst";
  const RunResults in = there_and_back(out);
  for (std::size_t c = 0; c < 12; ++c) {
    EXPECT_EQ(in.contacts[c].name, out.contacts[c].name);
    EXPECT_EQ(in.series.contacts[c].displacement, out.series.contacts[c].displacement);
  }
}

TEST(Archive, HasTheLayoutOfTheContract) {
  const Folder folder;
  write_archive(folder / "results.h5", made_up({.contacts = 2, .outputs = 50, .modes = 4, .elements = 10}));
  const h5::Group root = h5::Group::open_file(folder / "results.h5");
  EXPECT_EQ(root.shape("time"), (h5::Shape{50}));
  const h5::Group contact = root.open("contacts").open("tsp1");
  EXPECT_EQ(contact.shape("displacement"), (h5::Shape{50, 3}));
  EXPECT_EQ(contact.shape("velocity"), (h5::Shape{50, 3}));
  EXPECT_EQ(contact.shape("gap"), (h5::Shape{50}));
  EXPECT_EQ(contact.shape("normal_force"), (h5::Shape{50}));
  EXPECT_EQ(contact.shape("tangential_force"), (h5::Shape{50, 2}));
  EXPECT_EQ(contact.shape("state"), (h5::Shape{50}));
  EXPECT_EQ(contact.values<double>("position").size(), 3u);
  const h5::Group impacts = contact.open("impacts");
  EXPECT_EQ(impacts.children(),
            (std::vector<std::string>{"duration", "energy_lost", "impulse", "peak_force", "rebounds", "start",
                                      "velocity_after", "velocity_before"}));
  EXPECT_EQ(impacts.number("rest_time"), 1e-3);
  EXPECT_EQ(root.open("nodes").open("apex").shape("acceleration"), (h5::Shape{50, 3}));
  EXPECT_EQ(root.open("modal").shape("displacement"), (h5::Shape{50, 4}));
  EXPECT_EQ(root.open("modal").shape("velocity"), (h5::Shape{50, 4}));
  const h5::Group modes = root.open("modes");
  EXPECT_EQ(modes.shape("frequency"), (h5::Shape{4}));
  EXPECT_EQ(modes.shape("damping"), (h5::Shape{4}));
  EXPECT_EQ(modes.shape("mass"), (h5::Shape{4}));
  EXPECT_EQ(modes.shape("shapes"), (h5::Shape{4, 11, 6}));
  EXPECT_EQ(modes.shape("nodes"), (h5::Shape{11}));
  EXPECT_EQ(root.open("mesh").shape("nodes"), (h5::Shape{11, 3}));
  EXPECT_EQ(root.open("mesh").shape("lines"), (h5::Shape{10, 2}));
}

TEST(Archive, OrdersShapesByModeNodeAndDof) {
  RunResults out = made_up({.outputs = 0, .modes = 2, .elements = 3});
  for (Eigen::Index k = 0; k < 2; ++k)
    for (Eigen::Index row = 0; row < 24; ++row)
      out.bases[0].shapes(row, k) = static_cast<double>(100 * k + row);
  const Folder folder;
  write_archive(folder / "results.h5", out);
  const auto shapes = h5::Group::open_file(folder / "results.h5").open("modes").read<double>("shapes");
  EXPECT_EQ(shapes[(1 * 4 + 2) * 6 + 5], 117.0); // mode 1, node 2, rz
}

TEST(Archive, NumbersTheStructuresWhenThereAreSeveral) {
  const Folder folder;
  write_archive(folder / "results.h5", made_up({.structures = 3}));
  const h5::Group modes = h5::Group::open_file(folder / "results.h5").open("modes");
  EXPECT_EQ(modes.children(), (std::vector<std::string>{"0", "1", "2"}));
  EXPECT_TRUE(modes.open("2").has("shapes"));
}

TEST(Archive, HasContactsButNoSeriesWithoutATransient) {
  const RunResults in = there_and_back(made_up({.contacts = 2, .outputs = 0}));
  EXPECT_EQ(in.contacts.size(), 2u);
  EXPECT_TRUE(in.series.contacts.empty());
  EXPECT_EQ(in.series.time.size(), 0);
}

TEST(Archive, HasTheSameBytesForTheSameResultsAtAnotherTime) {
  const Folder folder;
  RunResults results = made_up({.structures = 2});
  write_archive(folder / "results.h5", results);
  const std::string first = bytes_of(folder / "results.h5");
  std::this_thread::sleep_for(std::chrono::milliseconds(1100)); // HDF5 would store times in seconds
  results.timings.total = 77.0;
  results.record.ranks = 2;
  results.record.vector_width = "SSE2 (2 doubles)";
  write_archive(folder / "results.h5", results);
  EXPECT_EQ(bytes_of(folder / "results.h5"), first);
  results.series.contacts[2].gap(5) += 1e-12;
  write_archive(folder / "results.h5", results);
  EXPECT_NE(bytes_of(folder / "results.h5"), first);
}

TEST(Archive, KeepsAStudyLongerThanAnObjectHeader) {
  RunResults out = made_up({.outputs = 0});
  out.record.study_text = std::string(300000, '#');
  EXPECT_EQ(there_and_back(out).record.study_text, out.record.study_text);
}

TEST(Archive, HoldsARunThatWasCutShort) {
  const RunResults out = made_up({.contacts = 1, .outputs = 1}), in = there_and_back(out);
  EXPECT_EQ(in.series.time.size(), 1);
  EXPECT_EQ(in.series.contacts[0].displacement, out.series.contacts[0].displacement);
}

TEST(Archive, CutsSeriesToTheCommonTimeWhereOneStructureStoppedEarly) {
  RunResults out = made_up({.contacts = 2, .outputs = 40, .structures = 2});
  out.series.time.conservativeResize(10);
  out.series.modal_displacement.conservativeResize(Eigen::NoChange, 10);
  out.series.modal_velocity.conservativeResize(Eigen::NoChange, 10);
  const RunResults in = there_and_back(out);
  EXPECT_EQ(in.series.contacts[1].displacement, out.series.contacts[1].displacement.topRows(10));
  EXPECT_EQ(in.series.contacts[1].normal_force, out.series.contacts[1].normal_force.head(10));
  EXPECT_EQ(in.series.nodes[0].velocity, out.series.nodes[0].velocity.topRows(10));
}

std::string refusal(const std::filesystem::path& directory) {
  try {
    (void)read_archive(directory);
  } catch (const core::Error& error) {
    return error.what();
  }
  return {};
}

TEST(Archive, TellsAFolderWithoutResults) {
  const Folder folder;
  EXPECT_THAT(refusal(folder.path()), HasSubstr(folder.path().string() + ": there are no results here"));
}

TEST(Archive, TellsAFolderOfASweep) {
  const Folder folder;
  write_bytes(folder / "table.h5", "");
  EXPECT_THAT(refusal(folder.path()),
              AllOf(HasSubstr("holds the results of a sweep, whose table is table.csv"),
                    HasSubstr((folder / "runs/case_N").string())));
}

TEST(Archive, TellsADamagedFile) {
  const Folder folder;
  write_archive(folder / "results.h5", made_up());
  const std::string bytes = bytes_of(folder / "results.h5");
  for (const std::string& damaged :
       {bytes.substr(0, bytes.size() / 2), std::string("no HDF5"), std::string()}) {
    write_bytes(folder / "results.h5", damaged);
    EXPECT_THAT(refusal(folder.path()), HasSubstr("results.h5: cannot be read"));
  }
}

TEST(Archive, TellsContentThatContradictsItself) {
  const Folder folder;
  const auto refused = [&](const char* part, auto change) {
    RunResults results = made_up();
    change(results);
    write_archive(folder / "results.h5", results);
    EXPECT_THAT(refusal(folder.path()), HasSubstr(part));
  };
  refused("lines of the mesh",
          [](RunResults& r) { r.lines[0][1] = static_cast<core::Index>(r.nodes.size()); });
  refused("lines of the mesh", [](RunResults& r) { r.lines[0][0] = -1; });
  refused("nodes of the modes", [](RunResults& r) { r.bases[0].nodes[1] = 1'000'000; });
  refused("series of contact",
          [](RunResults& r) { r.series.contacts[0].velocity.conservativeResize(Eigen::NoChange, 2); });
  refused("series of contact",
          [](RunResults& r) { r.series.contacts[0].normal.conservativeResize(Eigen::NoChange, 1); });
  refused("nodes of contact", [](RunResults& r) { r.contacts[0].point.motion[0].node = 1'000'000; });
  refused("series of the modes", [](RunResults& r) {
    r.series.modal_displacement.conservativeResize(r.series.modal_displacement.rows() - 1, Eigen::NoChange);
  });
}

TEST(Archive, TellsAFileOfAnotherProgram) {
  const Folder folder;
  h5::MemoryFile().write(folder / "results.h5");
  EXPECT_THAT(refusal(folder.path()),
              HasSubstr("the file is damaged or not of this program; run the study again"));
}

TEST(Archive, TellsAFolderThatCannotBeWritten) {
  const Folder folder;
  write_bytes(folder / "a", "");
  try {
    write_archive(folder.path() / "a" / "results.h5", made_up());
    FAIL() << "written into a file";
  } catch (const core::Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("results.h5: cannot be written"));
  }
}

} // namespace
} // namespace fretwork::results::archive_test
