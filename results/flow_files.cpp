// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/flow_files.hpp"
#include "results/flow_text.hpp"
#include "results/text_file.hpp"
#include <fmt/format.h>
#include <iterator>

namespace fretwork::results {

void write_flow_csv(const std::filesystem::path& file, const std::vector<FlowRow>& rows) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(
      out,
      "tube,zone,s [m],velocity [m/s],density [kg/m3],void_fraction [1],fluid_inside [kg/m3],mass [kg/m]\n");
  for (const FlowRow& row : rows)
    fmt::format_to(out, "{},{},{},{},{},{},{},{}\n", quoted(row.tube), quoted(row.zone), row.s, row.velocity,
                   row.density, row.void_fraction, row.inner_density, row.mass);
  write_text(file, {text.data(), text.size()});
}

void write_spectra_csv(const std::filesystem::path& file, const std::vector<Spectrum>& spectra) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "name,quantity,unit,frequency [Hz],density,low_95,high_95\n");
  for (const Spectrum& spectrum : spectra)
    for (std::size_t k = 0; k < spectrum.frequency.size(); ++k)
      fmt::format_to(out, "{},{},{},{},{},{},{}\n", quoted(spectrum.name), quoted(spectrum.quantity),
                     spectrum.unit, spectrum.frequency[k], spectrum.density[k],
                     spectrum.lower * spectrum.density[k], spectrum.upper * spectrum.density[k]);
  write_text(file, {text.data(), text.size()});
}

} // namespace fretwork::results
