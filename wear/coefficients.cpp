// SPDX-License-Identifier: GPL-3.0-or-later
#include "wear/coefficients.hpp"
#include "core/error.hpp"
#include "core/names.hpp"
#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <string>
#include <vector>

namespace fretwork::wear {

namespace {

constexpr std::string_view bank = "Code_Aster 17, POST_USURE";
constexpr std::string_view cold_water = "published abstract: tube on steel 304 in cold water";

constexpr std::array table = {
    Coefficient{"flat_bar", "600_600", 120e-15, bank},
    Coefficient{"flat_bar", "600TT_600", 45e-15, bank},
    Coefficient{"flat_bar", "600TT_600TT", 1.4e-15, bank},
    Coefficient{"flat_bar", "600_600Cr", 72e-15, bank},
    Coefficient{"flat_bar", "600TT_600Cr", 0.91e-15, bank},
    Coefficient{"flat_bar", "690TT_600Cr", 1.2e-15, bank},
    Coefficient{"flat_bar", "600_Z10C13", 99e-15, bank},
    Coefficient{"flat_bar", "600_405", 62e-15, bank},
    Coefficient{"flat_bar", "690_405", 0.41e-15, bank},
    Coefficient{"flat_bar", "600TT_Z6C13", 9.2e-15, bank},
    Coefficient{"flat_bar", "600_Z6C13", 7.1e-15, bank},
    Coefficient{"flat_bar", "690_Z6C13", 7.7e-15, bank},
    Coefficient{"flat_bar", "600_347", 100e-15, bank},
    Coefficient{"drilled_hole", "690_Z10C13", 0.06e-15, bank},
    Coefficient{"drilled_hole", "600_600", 160e-15, bank},
    Coefficient{"drilled_hole", "690_600", 52e-15, bank},
    Coefficient{"drilled_hole", "600_600Cr", 2.2e-15, bank},
    Coefficient{"drilled_hole", "690_600Cr", 4.4e-15, bank},
    Coefficient{"four_lands", "600_Z10C13", 0.24e-15, bank},
    Coefficient{"four_lands", "690_Z10C13", 0.082e-15, bank},
    Coefficient{"four_lands", "600_405", 65e-15, bank},
    Coefficient{"four_lands", "600TT_405", 1.4e-15, bank},
    Coefficient{"four_lands", "690_405", 7.8e-15, bank},
    Coefficient{"three_lands", "600_Z10C13", 0.25e-15, bank},
    Coefficient{"three_lands", "690_Z10C13", 0.24e-15, bank},
    Coefficient{"tube_on_tube", "600_600", 180e-15, bank},
    Coefficient{"tube_on_tube", "690_690", 1000e-15, bank},
    Coefficient{"any", "690_304", 16.2e-15, cold_water},
    Coefficient{"any", "600_304", 9.3e-15, cold_water},
};

void add_new(std::vector<std::string>& names, std::string_view name) {
  if (std::find(names.begin(), names.end(), name) == names.end())
    names.emplace_back(name);
}

} // namespace

std::span<const Coefficient> coefficients() { return table; }

const Coefficient& coefficient(std::string_view geometry, std::string_view materials) {
  std::vector<std::string> classes, pairs, elsewhere;
  for (const auto& row : table) {
    add_new(classes, row.geometry);
    if (row.geometry == geometry && row.materials == materials)
      return row;
    if (row.geometry == geometry)
      add_new(pairs, row.materials);
    if (row.materials == materials)
      add_new(elsewhere, row.geometry);
  }
  if (pairs.empty())
    throw core::Error(fmt::format("wear coefficients: there is no geometry class \"{}\"{}", geometry,
                                  core::name_help(geometry, classes)));
  std::string hint;
  if (!elsewhere.empty())
    hint = fmt::format("; the pair has a coefficient for {}", core::list_names(elsewhere));
  throw core::Error(
      fmt::format("wear coefficients: the class \"{}\" has no pair tube_support \"{}\"{}{}; or give "
                  "the coefficient in m2/N",
                  geometry, materials, core::name_help(materials, pairs), hint));
}

std::string_view coefficient_class(const Geometry& geometry) {
  if (std::holds_alternative<FlatBar>(geometry) || std::holds_alternative<TubeOnTube>(geometry))
    return name_of(geometry);
  if (std::holds_alternative<DrilledHole>(geometry) || std::holds_alternative<Ring>(geometry))
    return "drilled_hole";
  const auto* lands = std::get_if<Lands>(&geometry);
  if (lands && lands->lands == 4)
    return "four_lands";
  if (lands && lands->lands == 3)
    return "three_lands";
  throw core::Error(fmt::format(
      "wear coefficients: there is no class for {}; name one of \"flat_bar\", "
      "\"drilled_hole\", \"four_lands\", \"three_lands\", \"tube_on_tube\", \"any\", or give the "
      "coefficient in m2/N",
      lands ? fmt::format("{} lands", lands->lands) : fmt::format("the geometry \"{}\"", name_of(geometry))));
}

} // namespace fretwork::wear
