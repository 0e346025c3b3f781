// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The parts of one entry of `[[contacts]]`; `read_contacts` calls them in turn. Each throws core::Error as
/// table_reader.hpp says, also for keys that another choice would need.
#pragma once
#include "study/study.hpp"
#include "study/table_reader.hpp"

namespace fretwork::study {

/// Whether a name is that of a contact, or of its support at one node of a group: `avb`, `avb[2]`. How many it has only the mesh knows.
[[nodiscard]] bool names_contact(std::string_view name, const std::string& contact);

/// obstacle and its sizes, other, distance_1, distance_2, side.
void read_obstacle(const TableReader& table, Contact& contact);
extern const std::vector<std::string> obstacle_keys;

/// The number of lands of a broached hole.
[[nodiscard]] int read_lands(const TableReader& table, int otherwise);

/// Stiffness and damper along the normal.
void read_normal_law(const TableReader& table, Contact& contact);
extern const std::vector<std::string> normal_law_keys;

void read_friction(const TableReader& table, Contact& contact);
extern const std::vector<std::string> friction_keys;

} // namespace fretwork::study
