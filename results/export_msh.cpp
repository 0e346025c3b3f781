// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/mode_fields.hpp"
#include "results/text_file.hpp"
#include "results/write.hpp"
#include <fmt/format.h>
#include <iterator>

namespace fretwork::results {
namespace {

constexpr int gmsh_line = 1, gmsh_point = 15;

/// All nodes in one block of a curve, lone nodes as point elements of a point entity.
void write_mesh(fmt::memory_buffer& text, const RunResults& results) {
  const auto out = std::back_inserter(text);
  const std::size_t nodes = results.nodes.size(), lines = results.lines.size();
  const std::vector<core::Index> lone = lone_nodes(results);
  fmt::format_to(out, "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 {0} 1 {0}\n1 1 0 {0}\n", nodes);
  for (std::size_t i = 1; i <= nodes; ++i)
    fmt::format_to(out, "{}\n", i);
  for (const core::Vec3& p : results.nodes)
    fmt::format_to(out, "{} {} {}\n", p.x(), p.y(), p.z());
  fmt::format_to(out, "$EndNodes\n$Elements\n{} {} 1 {}\n", (lines > 0) + (lone.empty() ? 0 : 1),
                 lines + lone.size(), lines + lone.size());
  std::size_t tag = 0;
  if (lines > 0)
    fmt::format_to(out, "1 1 {} {}\n", gmsh_line, lines);
  for (const auto& line : results.lines)
    fmt::format_to(out, "{} {} {}\n", ++tag, line[0] + 1, line[1] + 1);
  if (!lone.empty())
    fmt::format_to(out, "0 1 {} {}\n", gmsh_point, lone.size());
  for (const core::Index node : lone)
    fmt::format_to(out, "{} {}\n", ++tag, node + 1);
  fmt::format_to(out, "$EndElements\n");
}

} // namespace

void export_msh(const std::filesystem::path& directory, const RunResults& results) {
  require_mesh(results);
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  write_mesh(text, results);
  for (Eigen::Index k = 0; k < mode_count(results); ++k) {
    const ModeField field = mode_field(results, k);
    const Eigen::Index nodes = field.displacement.cols();
    // one text (the name), one real (the time), three integers (step, components, nodes)
    fmt::format_to(out, "$NodeData\n1\n\"{}\"\n1\n0.0\n3\n0\n3\n{}\n", field.name, nodes);
    for (Eigen::Index i = 0; i < nodes; ++i) {
      const auto u = field.displacement.col(i);
      fmt::format_to(out, "{} {} {} {}\n", i + 1, u(0), u(1), u(2));
    }
    fmt::format_to(out, "$EndNodeData\n");
  }
  write_text(directory / "modes.msh", {text.data(), text.size()});
}

} // namespace fretwork::results
