// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// One function for each top-level table of a study; `read` calls them in turn. Each throws core::Error as
/// table_reader.hpp says.
#pragma once
#include "study/study.hpp"
#include "study/table_reader.hpp"

namespace fretwork::study {

// Reading the structure.
[[nodiscard]] mesh::Source read_mesh(const TableReader& root, const std::filesystem::path& folder);
[[nodiscard]] std::map<std::string, fem::Material> read_materials(const TableReader& root);
[[nodiscard]] std::map<std::string, fem::Section> read_sections(const TableReader& root);
/// The materials and sections of `study` must have been read.
[[nodiscard]] std::vector<Beams> read_beams(const TableReader& root, const Study& study);
[[nodiscard]] std::vector<Restraint> read_restraints(const TableReader& root);
[[nodiscard]] std::vector<Mass> read_masses(const TableReader& root);
[[nodiscard]] std::vector<Spring> read_springs(const TableReader& root);
[[nodiscard]] std::vector<Tie> read_ties(const TableReader& root);

// Reading what acts on it; `folder` is where relative paths start.
[[nodiscard]] std::vector<Contact> read_contacts(const TableReader& root);
[[nodiscard]] std::vector<Flow> read_flows(const TableReader& root, const std::filesystem::path& folder);
/// The contacts and flows of `study` must have been read.
[[nodiscard]] std::vector<Stability> read_stabilities(const TableReader& root, const Study& study);
/// `pinned`: "contacts", "none" or names of contacts or of their supports (`avb[2]`). @param named  takes the names
void read_pinned(const TableReader& table, const std::vector<Contact>& contacts, Pinned& pinned,
                 std::vector<std::string>& named);
/// The flows of `study` must have been read.
[[nodiscard]] std::vector<Turbulence>
read_turbulence(const TableReader& root, const std::filesystem::path& folder, const Study& study);
/// The contacts and the turbulence of `study` must have been read.
[[nodiscard]] std::vector<Response> read_responses(const TableReader& root, const Study& study);
[[nodiscard]] std::vector<Load> read_loads(const TableReader& root, const std::filesystem::path& folder);
[[nodiscard]] std::optional<Vec3> read_gravity(const TableReader& root);
[[nodiscard]] std::vector<BaseMotion> read_base_motions(const TableReader& root,
                                                        const std::filesystem::path& folder);
[[nodiscard]] std::vector<SupportMotion> read_support_motions(const TableReader& root,
                                                              const std::filesystem::path& folder);
[[nodiscard]] std::vector<Initial> read_initial(const TableReader& root,
                                                const std::optional<Transient>& transient);

// Reading what is computed and kept.
[[nodiscard]] Modes read_modes(const TableReader& root);
[[nodiscard]] std::optional<Transient> read_transient(const TableReader& root);
[[nodiscard]] Output read_output(const TableReader& root, const std::optional<Transient>& transient);
[[nodiscard]] std::vector<Wear> read_wear(const TableReader& root, const std::filesystem::path& folder);
/// The wear must have been read.
[[nodiscard]] std::optional<GapOpening> read_gap_opening(const TableReader& root,
                                                         const std::vector<Wear>& wear);

} // namespace fretwork::study
