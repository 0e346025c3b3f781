// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/case_bases.hpp"
#include "app/flow_damping.hpp"
#include "app/fluidelastic.hpp"
#include "app/modes_limit.hpp"
#include "app/stability.hpp"
#include "app/static_modes.hpp"
#include "core/temporary_directory.hpp"
#include "results/whole_file.hpp"
#include "study/document.hpp"
#include "study/time_functions.hpp"
#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace fretwork::app {
namespace {

/// The address of an override.
std::vector<std::string> address_of(const std::string& override_text) {
  return study::address_parts(override_text.substr(0, override_text.find('=')));
}

/// True where what an override changes enters a case behind the structure.
bool is_of_case(const std::string& override_text) {
  constexpr std::array tables{"contacts", "contact_defaults", "output",   "wear",
                              "title",    "stability",        "response", "transient"};
  constexpr std::size_t of_entry = 2; // table, entry, key
  const std::vector<std::string> address = address_of(override_text);
  const std::string table = address.front(), key = address.size() > of_entry ? address[of_entry] : "";
  if (std::find(tables.begin(), tables.end(), table) != tables.end())
    return true;
  if (table == "turbulence")
    return key == "seed";
  const auto& functions = study::time_function_keys;
  return table == "loads" && std::find(functions.begin(), functions.end(), key) != functions.end();
}

std::string key_of_structure(const std::vector<std::string>& overrides) {
  std::string key;
  for (const std::string& text : overrides)
    if (!is_of_case(text))
      key += text + "\n";
  return key;
}

/// The bytes of a value.
template <class T> void append(std::string& key, const T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  key.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// All of the contacts that modes, damping and flexibility depend on.
std::string key_of_contacts(const study::Study& study, const std::vector<PlacedContact>& placed,
                            const std::vector<PlacedContact>& inactive) {
  std::string key;
  const auto append_numbers = [&](const auto& matrix) {
    for (Eigen::Index i = 0; i < matrix.size(); ++i)
      append(key, matrix.data()[i]);
  };
  for (const PlacedContact& contact : placed) {
    const study::Contact& entry = study.contacts[contact.entry];
    append(key, contact.node);
    append(key, contact.other);
    for (const fem::NodeShare& share : contact.motion) {
      append(key, share.node);
      append_numbers(share.weights);
    }
    append_numbers(Eigen::Matrix3d(contact.frame.rotation()));
    const auto [y, z] = contact::normal_directions(contact.obstacle);
    append(key, y);
    append(key, z);
    append(key, entry.friction_static > 0.0);
    append(key, entry.friction_along.x);
    append(key, entry.friction_along.t);
    append(key, entry.thickness);
  }
  key += "inactive";
  for (const PlacedContact& contact : inactive) {
    append(key, contact.node);
    append(key, contact.other);
  }
  return key;
}

/// All that modes with pins at contacts depend on. @param all  inactive ones included
std::string key_of_pins(const study::Study& study, const std::vector<PlacedContact>& all) {
  const bool elastic = std::any_of(study.stabilities.begin(), study.stabilities.end(),
                                   [](const study::Stability& one) { return one.elastic; });
  std::string key = fmt::format("{} modes, up to {:.17g} Hz\n", study.modes.count.value_or(0),
                                study.modes.up_to_hz.value_or(0.0)) +
                    key_of_contacts(study, all, {});
  for (const PlacedContact& contact : all) {
    const study::Contact& entry = study.contacts[contact.entry];
    append(key, contact.active);
    append(key, entry.tangential_stiffness > 0.0);
    if (elastic) {
      append(key, contact.normal_stiffness);
      append(key, entry.tangential_stiffness);
    }
  }
  return key;
}

/// Of a case whose mesh is not that of the study.
mesh::LineMesh own_mesh(const study::Study& study) {
  mesh::Source source = study.mesh;
  if (mesh::is_msh(source.file))
    return mesh::read(source);
  const core::TemporaryDirectory folder;
  source.file = folder.path() / "mesh.msh";
  results::write_whole(source.file, {mesh::as_msh(study.mesh)}, results::Durability::cached);
  source.element_size.reset(); // it has been obeyed
  return mesh::read(source);
}

CaseStructure make_structure(const Inputs& nominal, const study::Study& study, bool same_mesh) {
  CaseStructure out;
  std::vector<std::string> notes;
  out.mesh = same_mesh ? mesh_stage(MPI_COMM_SELF, nominal) : own_mesh(study);
  out.dry = out.model = build_model(study, out.mesh);
  out.flows = place_flows(study, out.mesh, out.model, notes);
  out.turbulence = turbulent_loads(study, out.model, out.flows, notes);
  out.structures = moving_structures(out.model);
  out.fields =
      build_fields(study, out.mesh, out.model, out.flows,
                   support_fields(moved_supports(study, out.mesh, out.model), out.model, out.structures));
  return out;
}

CaseContacts make_contacts(const study::Study& study, const CaseStructure& structure,
                           const std::vector<modal::Basis>& modes, const std::vector<PlacedContact>& placed,
                           const std::vector<PlacedContact>& inactive) {
  CaseContacts out;
  out.bases = modes;
  if (study.modes.static_modes == study::StaticModes::added)
    add_static_modes(MPI_COMM_SELF, study, structure.model, structure.structures, placed, out.bases);
  const TubesInFlow tubes{study, structure.mesh, structure.model, structure.flows};
  if (study.modes.flow_damping)
    (void)damp_by_flow(tubes, DampingSet::transient, placed, inactive, out.bases);
  out.fluid = fluidelastic_forces(tubes, out.bases);
  out.joined = joined_structures(out.bases, placed, out.fluid);
  out.flexibilities = contact_flexibilities(MPI_COMM_SELF, study, structure.model, structure.structures,
                                            out.bases, out.joined, placed);
  std::vector<std::string> notes;
  for (const std::vector<std::size_t>& scene : out.joined) {
    std::vector<const modal::Basis*> bases;
    for (const std::size_t s : scene)
      bases.push_back(&out.bases[s]);
    auto& loads = out.turbulence.emplace_back();
    for (const TurbulentLoad& load : structure.turbulence)
      loads.push_back(sampled_load(load, bases, notes));
  }
  return out;
}

bool changes_mesh(const std::vector<std::string>& overrides) {
  return std::any_of(overrides.begin(), overrides.end(),
                     [](const std::string& text) { return address_of(text).front() == "mesh"; });
}

} // namespace

std::shared_ptr<const CaseStructure> CaseBases::structure(const study::Study& study,
                                                          const std::vector<std::string>& overrides) {
  return structures_.get(key_of_structure(overrides),
                         [&] { return make_structure(nominal_, study, !changes_mesh(overrides)); });
}

std::shared_ptr<const CaseContacts> CaseBases::contacts(study::Study& study,
                                                        const std::vector<std::string>& overrides,
                                                        const CaseStructure& structure,
                                                        const std::vector<PlacedContact>& placed,
                                                        const std::vector<PlacedContact>& inactive) {
  std::string key = key_of_structure(overrides);
  if (auto limit = take_modes_limit(study, structure.model, placed, structure.turbulence)) {
    static_cast<void>(cap_default_modes(study, structure.model, placed, *limit));
    key += fmt::format("up to {:.17g} Hz\n", limit->up_to);
  }
  const auto modes = modes_.get(
      key, [&] { return compute_modes(MPI_COMM_SELF, study.modes, structure.model, structure.structures); });
  return contacts_.get(key + key_of_contacts(study, placed, inactive),
                       [&] { return make_contacts(study, structure, *modes, placed, inactive); });
}

std::shared_ptr<const ConnorsStability> CaseBases::stability(const study::Study& study,
                                                             const std::vector<std::string>& overrides,
                                                             const CaseStructure& structure,
                                                             const std::vector<PlacedContact>& all) {
  std::string key = key_of_structure(overrides) + key_of_pins(study, all);
  for (const std::string& text : overrides)
    if (address_of(text).front() == "stability")
      key += text + "\n";
  const TubesInFlow tubes{study, structure.mesh, structure.model, structure.flows};
  return stabilities_.get(key, [&] { return connors_stability(MPI_COMM_SELF, tubes, all); });
}

} // namespace fretwork::app
