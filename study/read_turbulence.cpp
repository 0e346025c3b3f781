// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/readers.hpp"
#include "study/spectrum_rows.hpp"
#include <algorithm>
#include <limits>

namespace fretwork::study {
namespace {

using enum Range;

enum class SpectrumKind { cor_1, cor_2, cor_3, cor_4, axisa, interior, inlet, two_phase, table };
const Choices<SpectrumKind> spectra{{{"cor_1", SpectrumKind::cor_1},
                                     {"cor_2", SpectrumKind::cor_2},
                                     {"cor_3", SpectrumKind::cor_3},
                                     {"cor_4", SpectrumKind::cor_4},
                                     {"axisa", SpectrumKind::axisa},
                                     {"interior", SpectrumKind::interior},
                                     {"inlet", SpectrumKind::inlet},
                                     {"two_phase", SpectrumKind::two_phase},
                                     {"table", SpectrumKind::table}}};

/// The constants of a spectrum, each with its default. @param values  take what the study gives
void read_constants(const TableReader& table, const std::vector<std::pair<std::string, double*>>& values) {
  const Value* found = table.find("constants");
  if (!found)
    return;
  if (values.empty())
    table.fail_at("constants", "this spectrum has none that may be set; leave them out, or give a table");
  Keys keys;
  for (const auto& [name, value] : values)
    keys.known.push_back(name);
  const TableReader constants(*found, table.path("constants"), keys);
  for (const auto& [name, value] : values)
    *value = constants.number_or(name, *value, {above_zero});
}

flow::TableSpectrum read_table(const TableReader& table, const std::filesystem::path& folder) {
  flow::TableSpectrum out;
  const SpectrumRows rows = read_spectrum_rows(table, "table", folder);
  out.x = rows.frequency;
  out.y = rows.density;
  out.absolute = table.choice("table_frequency", false, Choices<bool>{{{"reduced", false}, {"hz", true}}});
  return out;
}

flow::Spectrum read_spectrum(const TableReader& table, const std::filesystem::path& folder) {
  (void)table.required("spectrum", "the name of a spectrum, \"cor_3\" or another (doc/turbulence.md)");
  const SpectrumKind kind = table.choice("spectrum", SpectrumKind::table, spectra);
  if (kind != SpectrumKind::table)
    for (const char* key : {"table", "table_frequency"})
      if (table.has(key))
        table.fail_at(key, "belongs to spectrum = \"table\"; leave it out, or give that spectrum");
  std::vector<std::pair<std::string, double*>> constants;
  flow::Cor2 two;
  flow::Cor3 three;
  flow::Cor4 four;
  if (kind == SpectrumKind::cor_2)
    constants = {{"phi0", &two.phi0}, {"f_c", &two.f_c}, {"beta", &two.beta}};
  if (kind == SpectrumKind::cor_3)
    constants = {{"f_c", &three.f_c},
                 {"phi_low", &three.phi_low},
                 {"beta_low", &three.beta_low},
                 {"phi_high", &three.phi_high},
                 {"beta_high", &three.beta_high}};
  if (kind == SpectrumKind::cor_4)
    constants = {{"beta", &four.beta}, {"gamma", &four.gamma}};
  read_constants(table, constants);
  switch (kind) {
  case SpectrumKind::cor_1:
    return flow::Cor1{};
  case SpectrumKind::cor_2:
    return two;
  case SpectrumKind::cor_3:
    return three;
  case SpectrumKind::cor_4:
    return four;
  case SpectrumKind::axisa:
    return flow::Axisa{};
  case SpectrumKind::interior:
    return flow::Interior{};
  case SpectrumKind::inlet:
    return flow::Inlet{};
  case SpectrumKind::two_phase:
    return flow::TwoPhaseSpectrum{0.0};
  case SpectrumKind::table:
    return read_table(table, folder);
  }
  return flow::Cor1{};
}

/// One name, or an array of them.
std::vector<std::string> read_names(const TableReader& table, const char* key, const char* expected) {
  const Value* found = table.find(key);
  if (!found)
    return {};
  if (!found->array())
    return {to_text(*found, table.path(key))};
  std::vector<std::string> out;
  for (const Value& item : to_array(*found, table.path(key), expected))
    out.push_back(to_text(item, table.path(key)));
  return out;
}

std::optional<Band> read_band(const TableReader& table, const flow::Spectrum& spectrum) {
  const auto band = table.optional_numbers("band", 2, {Range::at_least_zero, "Hz"});
  if (std::holds_alternative<flow::Cor4>(spectrum) && (!band || (*band)[0] == 0.0)) {
    const std::string problem =
        "cor_4 grows without bound towards f = 0; give band = [low, high] in Hz with low > 0";
    band ? table.fail_at("band", problem) : table.fail_at("spectrum", problem);
  }
  if (!band)
    return std::nullopt;
  if ((*band)[0] >= (*band)[1])
    table.fail_at("band",
                  "the lower frequency is expected first, and below the upper one; write [low, high]");
  return Band{(*band)[0], (*band)[1]};
}

void read_weights(const TableReader& table, Turbulence& out) {
  out.lift = table.number_or("lift", out.lift, {Range::at_least_zero});
  out.drag = table.number_or("drag", out.drag, {Range::at_least_zero});
  if (out.lift == 0.0 && out.drag == 0.0)
    table.fail_at("drag", "without lift and drag nothing acts; give one of them a weight above 0");
}

void read_scaling(const TableReader& table, Turbulence& out) {
  out.scaling = table.choice(
      "scaling", flow::Scaling::local,
      Choices<flow::Scaling>{{{"local", flow::Scaling::local}, {"zone_mean", flow::Scaling::zone_mean}}});
  out.running_velocity = table.optional_number("running_velocity", {above_zero, "m/s"});
  if (out.running_velocity && out.scaling == flow::Scaling::local)
    table.fail_at("running_velocity",
                  "belongs to scaling = \"zone_mean\"; leave it out, or give that scaling");
}

} // namespace

std::vector<Turbulence> read_turbulence(const TableReader& root, const std::filesystem::path& folder,
                                        const Study& study) {
  std::vector<Turbulence> all;
  for (const Entry& entry : array_entries(root, "turbulence")) {
    const TableReader table(
        *entry.value, entry.path,
        {{"name", "flow", "zones", "spectrum", "constants", "table", "table_frequency", "correlation_length",
          "lift", "drag", "scaling", "running_velocity", "two_sided", "band", "seed", "ramp"}});
    if (study.flows.empty())
      table.fail_table("there is no [[flow]] that is turbulent; add it, or leave [[turbulence]] out");
    Turbulence out;
    out.name = table.optional_text("name").value_or("turbulence " + std::to_string(all.size() + 1));
    out.flows = read_names(table, "flow", "an array of names of flows");
    out.zones = read_names(table, "zones", "an array of names of zones");
    out.spectrum = read_spectrum(table, folder);
    out.correlation_length = table.number("correlation_length", {above_zero, "m"});
    read_weights(table, out);
    read_scaling(table, out);
    out.two_sided = table.optional_flag("two_sided").value_or(false);
    out.band = read_band(table, out.spectrum);
    const std::int64_t seed = table.optional_integer("seed", 0).value_or(1);
    if (seed > std::numeric_limits<std::uint32_t>::max())
      table.fail_at("seed", "a seed below 2^32 is expected");
    out.seed = static_cast<std::uint32_t>(seed);
    out.ramp = table.number_or("ramp", 0.0, {Range::at_least_zero, "s"});
    for (const Turbulence& before : all)
      if (before.name == out.name)
        table.fail_table("a second turbulence called \"" + out.name + "\"; give each a name of its own");
    all.push_back(std::move(out));
  }
  return all;
}

std::vector<Response> read_responses(const TableReader& root, const Study& study) {
  std::vector<Response> all;
  for (const Entry& entry : array_entries(root, "response")) {
    const TableReader table(*entry.value, entry.path,
                            {{"name", "pinned", "damping", "duration", "probability"}});
    if (study.turbulence.empty())
      table.fail_table("there is no [[turbulence]] to respond to; add it, or leave [[response]] out");
    Response out;
    out.name = table.optional_text("name").value_or("response " + std::to_string(all.size() + 1));
    read_pinned(table, study.contacts, out.pinned, out.contacts);
    out.damping = table.optional_number("damping", {above_zero});
    if (out.damping && *out.damping >= 1.0)
      table.fail_at("damping", "a ratio to critical below 1 is expected; 0.01 is 1 %");
    out.duration = table.number_or("duration", out.duration, {above_zero, "s"});
    out.probability = table.number_or("probability", out.probability, {above_zero});
    if (out.probability >= 1.0)
      table.fail_at("probability", "a probability below 1 is expected; 0.5 is the median of the maxima");
    for (const Response& before : all)
      if (before.name == out.name)
        table.fail_table("a second response called \"" + out.name + "\"; give each a name of its own");
    all.push_back(std::move(out));
  }
  return all;
}

} // namespace fretwork::study
