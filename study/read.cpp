// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/document.hpp"
#include "study/flow_tables.hpp"
#include "study/readers.hpp"
#include "study/spectrum_rows.hpp"
#include "study/sweep.hpp"
#include "study/time_functions.hpp"
#include <algorithm>
#include <cassert>

namespace fretwork::study {
namespace {

const Keys study_keys{
    {"title",          "mesh",       "materials",  "sections", "beams",    "restraints",
     "masses",         "springs",    "ties",       "modes",    "contacts", "flow",
     "stability",      "turbulence", "response",   "loads",    "gravity",  "base_motion",
     "support_motion", "initial",    "transient",  "output",   "wear",     "contact_defaults",
     "sweep",          "flow_laws",  "gap_opening"}};

[[maybe_unused]] bool is_key(const std::string& name) {
  return std::find(study_keys.known.begin(), study_keys.known.end(), name) != study_keys.known.end();
}

} // namespace

Study read(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  const Document document = load(file, overrides);
  const bool varied = document.root.table()->contains("sweep");
  if (varied)
    (void)read_sweep(document);
  Study study = read(document, overrides);
  study.varied = varied;
  return study;
}

Study read(const Document& document, const std::vector<std::string>& overrides) {
  const std::filesystem::path folder = document.file.parent_path();
  const TableReader root(document.root, "", study_keys);
  Study study;
  study.file = document.file;
  study.text = document.text;
  if (!overrides.empty() && !study.text.ends_with('\n'))
    study.text += '\n';
  for (const std::string& text : overrides)
    study.text += "# --set " + text + "\n";
  study.overrides = overrides;
  study.title = root.optional_text("title").value_or("");
  study.mesh = read_mesh(root, folder);
  study.materials = read_materials(root);
  study.sections = read_sections(root);
  study.beams = read_beams(root, study);
  study.restraints = read_restraints(root);
  study.masses = read_masses(root);
  study.springs = read_springs(root);
  study.ties = read_ties(root);
  study.modes = read_modes(root);
  study.contacts = read_contacts(root);
  study.flows = read_flows(root, folder);
  study.stabilities = read_stabilities(root, study);
  study.turbulence = read_turbulence(root, folder, study);
  study.responses = read_responses(root, study);
  study.loads = read_loads(root, folder);
  study.gravity = read_gravity(root);
  study.base_motions = read_base_motions(root, folder);
  study.support_motions = read_support_motions(root, folder);
  study.transient = read_transient(root);
  study.initial = read_initial(root, study.transient);
  study.output = read_output(root, study.transient);
  study.wear = read_wear(root, folder);
  study.gap_opening = read_gap_opening(root, study.wear);
  return study;
}

std::string canonical_text(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                           const std::vector<std::string>& tables) {
  Document document = load(file, overrides);
  const std::filesystem::path folder = document.file.parent_path();
  auto& root = std::get<Table>(document.root.data);
  assert(std::all_of(tables.begin(), tables.end(), is_key));
  std::string text;
  for (const auto& name : study_keys.known) {
    const auto at = root.find(name);
    if (at == root.end() || std::find(tables.begin(), tables.end(), name) == tables.end())
      continue;
    if (auto* output = std::get_if<Table>(&at->second.data); output && name == "output") {
      output->erase("checkpoint"); // no result depends on it
      if (output->empty())
        continue;
    }
    if (auto* transient = std::get_if<Table>(&at->second.data); transient && name == "transient")
      transient->erase("max_hours");
    if (auto* mesh = std::get_if<Table>(&at->second.data); mesh && name == "mesh")
      mesh->erase("trusted"); // how a file is read, not what it holds
    if (auto* entries = std::get_if<Array>(&at->second.data);
        entries && (name == "loads" || name == "base_motion" || name == "support_motion"))
      for (std::size_t i = 0; i < entries->size(); ++i)
        inline_time_table((*entries)[i], name + "." + std::to_string(i), folder);
    if (auto* entries = std::get_if<Array>(&at->second.data); entries && name == "flow")
      for (std::size_t i = 0; i < entries->size(); ++i)
        inline_flow_tables((*entries)[i], name + "." + std::to_string(i), folder);
    if (auto* entries = std::get_if<Array>(&at->second.data); entries && name == "turbulence")
      for (std::size_t i = 0; i < entries->size(); ++i)
        inline_spectrum_rows((*entries)[i], name + "." + std::to_string(i), folder);
    text += name + " = " + toml_text(at->second, Digits::seventeen) + "\n";
  }
  return text;
}

} // namespace fretwork::study
