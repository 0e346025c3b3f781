// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/beam_file.hpp"
#include "results/basis_file.hpp"
#include <algorithm>
#include <limits>

namespace fretwork::results {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr const char* section_units =
    "area: m2; iy, iz, torsion_constant, polar_inertia: m4; sizes: m, as in the study "
    "file; shear: none, shape (Cowper) or given (coefficients y, z)";

using Pair = std::array<double, 2>;

std::pair<std::string, Pair> shape_of(const fem::Shape& shape) {
  struct Names {
    std::pair<std::string, Pair> operator()(std::monostate) const { return {"general", {none, none}}; }
    std::pair<std::string, Pair> operator()(const fem::Pipe& s) const {
      return {"pipe", {s.outer_diameter, s.thickness}};
    }
    std::pair<std::string, Pair> operator()(const fem::Circle& s) const {
      return {"circle", {s.diameter, none}};
    }
    std::pair<std::string, Pair> operator()(const fem::Rectangle& s) const {
      return {"rectangle", {s.height_y, s.height_z}};
    }
  };
  return std::visit(Names{}, shape);
}

std::pair<std::string, Pair> shear_of(const fem::Shear& shear) {
  if (const auto* given = std::get_if<fem::ShearCoefficients>(&shear))
    return {"given", {given->y, given->z}};
  return {std::holds_alternative<fem::ShapeShear>(shear) ? "shape" : "none", {none, none}};
}

Pair pair_of(const h5::Group& group, const std::string& name) {
  const auto values = group.values<double>(name);
  if (values.size() != 2)
    throw h5::Failure(name + " of a section");
  return {values[0], values[1]};
}

fem::Shape shape_from(const std::string& name, const Pair& sizes) {
  if (name == "general")
    return {};
  if (name == "pipe")
    return fem::Pipe{sizes[0], sizes[1]};
  if (name == "circle")
    return fem::Circle{sizes[0]};
  if (name == "rectangle")
    return fem::Rectangle{sizes[0], sizes[1]};
  throw h5::Failure("shape of a section: " + name);
}

fem::Shear shear_from(const std::string& name, const Pair& coefficients) {
  if (name == "none")
    return {};
  if (name == "shape")
    return fem::ShapeShear{};
  if (name == "given")
    return fem::ShearCoefficients{coefficients[0], coefficients[1]};
  throw h5::Failure("shear of a section: " + name);
}

void write_section(const h5::Group& group, const fem::Section& s) {
  const auto [shape, sizes] = shape_of(s.shape);
  const auto [shear, coefficients] = shear_of(s.shear);
  group.set("area", s.area);
  group.set("iy", s.iy);
  group.set("iz", s.iz);
  group.set("torsion_constant", s.torsion_constant);
  group.set("polar_inertia", s.polar_inertia);
  group.set("shape", shape);
  group.set<double>("sizes", sizes, {2});
  group.set("shear", shear);
  group.set<double>("shear_coefficients", coefficients, {2});
  group.set("rotary_inertia", std::int64_t{s.rotary_inertia});
  group.set("units", std::string(section_units));
}

fem::Section read_section(const h5::Group& group) {
  return {.area = group.number("area"),
          .iy = group.number("iy"),
          .iz = group.number("iz"),
          .torsion_constant = group.number("torsion_constant"),
          .polar_inertia = group.number("polar_inertia"),
          .shape = shape_from(group.text("shape"), pair_of(group, "sizes")),
          .shear = shear_from(group.text("shear"), pair_of(group, "shear_coefficients")),
          .rotary_inertia = group.integer("rotary_inertia") != 0};
}

void write_property(const h5::Group& group, const fem::BeamProperty& p) {
  const core::Vec3 orientation = p.orientation.value_or(core::Vec3::Constant(none));
  group.set("young_modulus", p.material.young_modulus);
  group.set("poisson_ratio", p.material.poisson_ratio);
  group.set("density", p.material.density);
  group.set("axial_force", p.axial_force);
  group.set<double>("orientation", {orientation.data(), 3}, {3});
  group.set("units",
            std::string("young_modulus: Pa; density: kg/m3; axial_force: N; orientation: in the plane x-y"));
  write_section(group.create("section"), p.section);
  if (p.taper)
    write_section(group.create("far_section"), p.taper->section);
}

fem::BeamProperty read_property(const h5::Group& group) {
  fem::BeamProperty p{{group.number("young_modulus"), group.number("poisson_ratio"), group.number("density")},
                      read_section(group.open("section"))};
  p.axial_force = group.number("axial_force");
  const auto orientation = group.values<double>("orientation");
  if (orientation.size() != 3)
    throw h5::Failure("orientation of beams");
  if (orientation[0] == orientation[0]) // NaN: none
    p.orientation = core::Vec3(orientation[0], orientation[1], orientation[2]);
  if (group.has("far_section"))
    p.taper = fem::Taper{read_section(group.open("far_section"))};
  return p;
}

Eigen::MatrixXd rows_of(const h5::Group& mesh, const std::string& name, std::size_t rows,
                        Eigen::Index columns) {
  Eigen::MatrixXd values = read_matrix(mesh, name);
  if (values.rows() != static_cast<Eigen::Index>(rows) || values.cols() != columns)
    throw h5::Failure(name + " and lines of different sizes");
  return values;
}

} // namespace

void write_beams(const h5::Group& mesh, const RunResults& results) {
  const std::vector<fem::Beam>& beams = results.beams;
  if (beams.empty())
    return;
  const auto m = static_cast<Eigen::Index>(beams.size());
  std::vector<core::Index> numbers;
  Eigen::MatrixXd middles = Eigen::MatrixXd::Constant(m, 3, none), shares(m, 2);
  for (Eigen::Index i = 0; i < m; ++i) {
    const fem::Beam& beam = beams[static_cast<std::size_t>(i)];
    numbers.push_back(beam.property);
    if (beam.middle)
      middles.row(i) = beam.middle->transpose();
    shares.row(i) << beam.along[0], beam.along[1];
  }
  mesh.write<core::Index>("beam_properties", numbers, {numbers.size()}, "");
  if (std::any_of(beams.begin(), beams.end(), [](const fem::Beam& beam) { return beam.middle.has_value(); }))
    write_matrix(mesh, "arc_middles", middles, "m");
  if (std::any_of(results.properties.begin(), results.properties.end(),
                  [](const fem::BeamProperty& p) { return p.taper.has_value(); }))
    write_matrix(mesh, "taper_shares", shares, "1");
  const h5::Group properties = mesh.create("properties");
  for (std::size_t i = 0; i < results.properties.size(); ++i)
    write_property(properties.create(std::to_string(i)), results.properties[i]);
}

void read_beams(const h5::Group& mesh, RunResults& results) {
  if (!mesh.has("beam_properties"))
    return;
  const h5::Group properties = mesh.open("properties");
  for (std::size_t i = 0; properties.has(std::to_string(i)); ++i)
    results.properties.push_back(read_property(properties.open(std::to_string(i))));
  const auto numbers = mesh.read<core::Index>("beam_properties");
  if (numbers.size() != results.lines.size())
    throw h5::Failure("beam_properties and lines of different sizes");
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (numbers[i] < 0 || static_cast<std::size_t>(numbers[i]) >= results.properties.size())
      throw h5::Failure("a beam without property");
    results.beams.push_back({results.lines[i][0], results.lines[i][1], numbers[i]});
  }
  if (mesh.has("arc_middles")) {
    const Eigen::MatrixXd middles = rows_of(mesh, "arc_middles", numbers.size(), 3);
    for (Eigen::Index i = 0; i < middles.rows(); ++i)
      if (!middles.row(i).hasNaN())
        results.beams[static_cast<std::size_t>(i)].middle = core::Vec3(middles.row(i).transpose());
  }
  if (mesh.has("taper_shares")) {
    const Eigen::MatrixXd shares = rows_of(mesh, "taper_shares", numbers.size(), 2);
    for (Eigen::Index i = 0; i < shares.rows(); ++i)
      results.beams[static_cast<std::size_t>(i)].along = {shares(i, 0), shares(i, 1)};
  }
}

} // namespace fretwork::results
