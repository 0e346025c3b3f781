// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/describe.hpp"
#include "kernels/kernels.hpp"
#include "results/grouped_messages.hpp"
#include "results/totals.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <petscversion.h>
#include <slepcversion.h>

namespace fretwork::app {

results::RunRecord make_record(const Inputs& inputs, int ranks) {
  results::RunRecord record;
  record.version = FRETWORK_VERSION;
  record.title = inputs.study.title;
  record.study_text = inputs.study.text;
  record.overrides = inputs.study.overrides;
  record.input_sha256 = inputs.whole_key;
  for (const auto& load : inputs.study.loads)
    if (const auto* random = std::get_if<signals::Random>(&load.function))
      record.seeds.push_back(random->seed);
  for (const study::Turbulence& turbulence : inputs.study.turbulence)
    record.seeds.push_back(turbulence.seed);
  for (const auto& motion : inputs.study.base_motions)
    if (const auto* random = std::get_if<signals::Random>(&motion.acceleration))
      record.seeds.push_back(random->seed);
  for (const auto& motion : inputs.study.support_motions)
    if (const auto* random = std::get_if<signals::Random>(&motion.function))
      record.seeds.push_back(random->seed);
  record.libraries = {
      {"PETSc", fmt::format("{}.{}.{}", PETSC_VERSION_MAJOR, PETSC_VERSION_MINOR, PETSC_VERSION_SUBMINOR)},
      {"SLEPc", fmt::format("{}.{}.{}", SLEPC_VERSION_MAJOR, SLEPC_VERSION_MINOR, SLEPC_VERSION_SUBMINOR)},
      {"Eigen", fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)}};
  record.vector_width = kernels::vector_width();
  record.ranks = ranks;
  return record;
}

namespace {

bool is_told_early(const std::string& warning) {
  return warning.starts_with("units: ") || warning.starts_with("modes: ");
}

/// What the beams are made of: elements that differ by their masses alone (of the flow) have one property.
void describe_beams(const fem::Model& model, results::RunResults& out) {
  std::vector<core::Index> number;
  for (fem::BeamProperty property : model.properties) {
    property.added_mass = 0.0;
    property.added_mass_direction = fem::AddedMass::transverse;
    property.fluid = {};
    if (property.taper)
      property.taper = fem::Taper{property.taper->section};
    const auto found = std::find(out.properties.begin(), out.properties.end(), property);
    number.push_back(static_cast<core::Index>(found - out.properties.begin()));
    if (found == out.properties.end())
      out.properties.push_back(property);
  }
  out.beams = model.beams;
  for (fem::Beam& beam : out.beams)
    beam.property = number[static_cast<std::size_t>(beam.property)];
}

} // namespace

void describe_model(const mesh::LineMesh& mesh, const fem::Model& model,
                    const std::vector<fem::Structure>& structures, results::RunResults& out) {
  out.nodes = model.nodes;
  for (const std::string& name : mesh::group_names(mesh))
    out.groups[name] = mesh::group_nodes(mesh, name, "the results");
  for (const auto& beam : model.beams)
    out.lines.push_back({beam.a, beam.b});
  describe_beams(model, out);
  out.model.nodes = static_cast<std::int64_t>(model.nodes.size());
  out.model.elements = static_cast<std::int64_t>(model.beams.size());
  for (const auto& structure : structures)
    out.model.dofs += structure.equations;
  out.model.mass_kg = fem::total_mass(model);
}

std::string early_warnings(const results::RunResults& out) {
  std::string told;
  for (const std::string& warning : out.warnings)
    if (is_told_early(warning))
      told += fmt::format("warning: {}\n", warning);
  return told;
}

std::string check_messages(const results::RunResults& out, bool early) {
  std::string told;
  for (const std::string& warning : results::grouped_messages(out.warnings))
    if (!(early && is_told_early(warning)))
      told += fmt::format("  warning: {}\n", warning);
  for (const std::string& note : results::all_notes(out))
    told += fmt::format("  note: {}\n", note);
  return told;
}

} // namespace fretwork::app
