// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/error.hpp"
#include "folder.hpp"
#include "results/basis_file.hpp"
#include "results/write.hpp"
#include "synthetic.hpp"
#include <cmath>
#include <functional>
#include <gtest/gtest.h>

namespace fretwork::results::bases_test {
namespace {

/// Two structures; numbers with all their digits, a damping matrix without symmetry, a structure without
/// modes.
std::vector<modal::Basis> bases() {
  std::vector<modal::Basis> out = made_up({.outputs = 0, .structures = 2}).bases;
  for (modal::Basis& basis : out) {
    basis.shapes = basis.shapes.unaryExpr([](double x) { return std::sin(x + 1e-3); });
    basis.omega = basis.omega.unaryExpr([](double x) { return std::nextafter(x, 1e9); });
  }
  out[1].damping_matrix = Eigen::MatrixXd::NullaryExpr(
      6, 6, [](Eigen::Index i, Eigen::Index j) { return double(i) + 10.0 * double(j); });
  out[1].distributed = true;
  out[1].complete = true;
  out[1].static_modes = 2;
  modal::Basis none;
  none.nodes = {50};
  none.shapes.resize(6, 0);
  none.participation.resize(0, 3);
  out.push_back(none);
  return out;
}

TEST(Bases, ComeBackBitForBit) {
  const Folder folder;
  const auto out = bases();
  write_bases(folder / "modes.h5", {}, out, "key");
  const auto in = read_bases(folder / "modes.h5", "key").bases;
  ASSERT_TRUE(in);
  ASSERT_EQ(in->size(), out.size());
  for (std::size_t s = 0; s < out.size(); ++s) {
    const modal::Basis &a = (*in)[s], &b = out[s];
    EXPECT_EQ(a.nodes, b.nodes);
    ASSERT_EQ(a.shapes.rows(), b.shapes.rows());
    ASSERT_EQ(a.shapes.cols(), b.shapes.cols());
    EXPECT_EQ(a.shapes, b.shapes);
    EXPECT_EQ(a.omega, b.omega);
    EXPECT_EQ(a.damping, b.damping);
    ASSERT_EQ(a.damping_matrix.rows(), b.damping_matrix.rows());
    EXPECT_EQ(a.damping_matrix, b.damping_matrix);
    EXPECT_EQ(a.residuals, b.residuals);
    EXPECT_EQ(a.error, b.error);
    EXPECT_EQ(a.participation, b.participation);
    EXPECT_EQ(a.moving_mass, b.moving_mass);
    EXPECT_EQ(a.orthogonality, b.orthogonality);
    EXPECT_EQ(a.static_modes, b.static_modes);
    EXPECT_EQ(a.complete, b.complete);
    EXPECT_EQ(a.distributed, b.distributed);
  }
}

TEST(Bases, OfOneStructureAndOfNoneComeBack) {
  const Folder folder;
  for (const std::size_t count : {std::size_t{0}, std::size_t{1}}) {
    auto out = bases();
    out.resize(count);
    write_bases(folder / "modes.h5", {}, out, "key");
    const auto in = read_bases(folder / "modes.h5", "key").bases;
    ASSERT_TRUE(in);
    EXPECT_EQ(in->size(), count);
  }
}

TEST(Bases, AreNotThereWithoutAFileOrWithAnotherKey) {
  const Folder folder;
  EXPECT_FALSE(read_bases(folder / "modes.h5", "key").bases);
  write_bases(folder / "modes.h5", {}, bases(), "key");
  EXPECT_FALSE(read_bases(folder / "modes.h5", "another key").bases);
  EXPECT_FALSE(read_bases(folder / "modes.h5", "").bases);
  EXPECT_TRUE(read_bases(folder / "modes.h5", "key").bases);
}

TEST(Bases, AreNotThereWhereTheFileIsCutAnywhere) {
  const Folder folder;
  write_bases(folder / "modes.h5", {}, bases(), "key");
  const std::string bytes = bytes_of(folder / "modes.h5");
  for (std::size_t part = 0; part < 20; ++part) {
    write_bytes(folder / "cut.h5", bytes.substr(0, bytes.size() * part / 20));
    EXPECT_FALSE(read_bases(folder / "cut.h5", "key").bases) << part << "/20 of the file";
  }
  write_bytes(folder / "cut.h5", bytes.substr(0, bytes.size() - 1));
  EXPECT_FALSE(read_bases(folder / "cut.h5", "key").bases);
}

TEST(Bases, AreNotThereWhereTheFileIsSomethingElse) {
  const Folder folder;
  write_bytes(folder / "modes.h5", std::string(5000, '\x89'));
  EXPECT_FALSE(read_bases(folder / "modes.h5", "key").bases);
  std::filesystem::remove(folder / "modes.h5");
  std::filesystem::create_directory(folder / "modes.h5");
  EXPECT_FALSE(read_bases(folder / "modes.h5", "key").bases);
}

TEST(Bases, AreNotThereWhereSizesDoNotFit) {
  const Folder folder;
  const auto spoil = [&](const std::function<void(modal::Basis&)>& change) {
    std::vector<modal::Basis> out = bases();
    change(out[1]);
    write_bases(folder / "modes.h5", {}, out, "key");
    return !read_bases(folder / "modes.h5", "key").bases;
  };
  EXPECT_TRUE(spoil([](modal::Basis& basis) { basis.damping.conservativeResize(3); }));
  EXPECT_TRUE(spoil([](modal::Basis& basis) { basis.residuals.conservativeResize(3); }));
  EXPECT_TRUE(spoil([](modal::Basis& basis) { basis.error.conservativeResize(3); }));
  EXPECT_TRUE(spoil([](modal::Basis& basis) { basis.participation.conservativeResize(3, 3); }));
  EXPECT_TRUE(spoil([](modal::Basis& basis) { basis.damping_matrix.setZero(2, 2); }));
  EXPECT_TRUE(spoil([](modal::Basis& basis) { basis.static_modes = 7; }));
  EXPECT_FALSE(spoil([](modal::Basis&) {}));
}

TEST(Bases, ThatAreDamagedAreTold) {
  const Folder folder;
  write_bases(folder / "modes.h5", {}, bases(), "key");
  EXPECT_EQ(read_bases(folder / "modes.h5", "another key").refusal, "");
  EXPECT_EQ(read_bases(folder / "none.h5", "key").refusal, "");
  const std::string bytes = bytes_of(folder / "modes.h5");
  for (std::size_t at = 0; at < bytes.size(); at += bytes.size() / 97) {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ 1);
    write_bytes(folder / "modes.h5", damaged);
    const FoundBases found = read_bases(folder / "modes.h5", "key");
    EXPECT_FALSE(found.bases) << "byte " << at;
    EXPECT_NE(found.refusal.find("modes.h5 is damaged"), std::string::npos) << "byte " << at;
  }
}

TEST(Bases, WithTheMeshAreEnoughToExportModes) {
  const Folder folder;
  const RunResults out = made_up({.outputs = 0});
  write_bases(folder / "modes.h5", out.record, out.bases, "key", out.nodes, out.lines);
  const RunResults in = read_archive(folder.path());
  EXPECT_EQ(in.nodes, out.nodes);
  EXPECT_EQ(in.lines, out.lines);
  EXPECT_EQ(in.bases[0].shapes, out.bases[0].shapes);
  EXPECT_EQ(in.record.title, out.record.title);
}

TEST(Bases, ThatCannotBeWrittenAreAnError) {
  const Folder folder;
  std::filesystem::create_directory(folder / "modes.part.h5");
  try {
    write_bases(folder / "modes.h5", {}, bases(), "key");
    FAIL() << "written into a folder";
  } catch (const core::Error& error) {
    EXPECT_NE(std::string(error.what()).find("modes.h5: cannot be written: File exists"), std::string::npos);
  }
}

} // namespace
} // namespace fretwork::results::bases_test
