// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The child processes that read a geometry (gmsh) or a foreign format (meshio), within limits.
///
/// A geometry is a program: gmsh's language has loops, runs commands and writes files. Unless the file is trusted its child
/// - is confined to a temporary folder (core/confinement.hpp); where the system cannot do that, a geometry with a command that runs programs,
///   writes files or reads others is refused;
/// - is ended after `Source::longest_conversion`, and beyond `most_memory`, `most_file` and `most_output`.
#pragma once
#include "core/child_process.hpp"
#include "core/confinement.hpp"
#include "mesh/read.hpp"
#include <optional>

namespace fretwork::mesh {

/// A mesh of ten million lines takes about 2 GB and a file of 0.5 GB.
inline constexpr std::uint64_t most_memory = std::uint64_t{4} << 30; ///< bytes of address space
inline constexpr std::uint64_t most_file = std::uint64_t{2} << 30;   ///< bytes
inline constexpr std::uint64_t most_output = std::uint64_t{1} << 20; ///< bytes of messages

inline constexpr int of_a_signal = 128; ///< a status above it: the number of the signal that ended the child

class Converter {
public:
  /// @param folder  the only one in which the children may write
  /// @throws core::Error where the file has commands that nothing could confine
  Converter(const Source& source, const std::filesystem::path& folder);

  /// @throws core::Error where the child was ended by a limit, or tried to start a program
  [[nodiscard]] core::ChildResult run(const std::vector<std::string>& arguments) const;

private:
  [[noreturn]] void refuse(const std::string& why) const;

  const Source& source_;
  std::optional<core::Confinement> confinement_;
};

} // namespace fretwork::mesh
