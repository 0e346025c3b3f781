// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// [flow_laws.NAME]: laws of fluidelastic forces (flow/fluidelastic_law.hpp) that [[flow]] names.
#pragma once
#include "flow/fluidelastic_law.hpp"
#include "study/table_reader.hpp"

namespace fretwork::study {

struct NamedLaw {
  std::string name;
  flow::FluidelasticLaw law;
};
/// In the order of the file.
[[nodiscard]] std::vector<NamedLaw> read_flow_laws(const TableReader& root);

} // namespace fretwork::study
