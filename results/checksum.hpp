// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The checksums of the files that are read back. They are verified before a library looks at the content.
///
/// - An HDF5 file begins with a user block of 512 bytes, which HDF5 passes over: a line of text with the SHA-256 of all that follows it.
/// - A summary ends with the key "sha256": the SHA-256 of its text in which these 64 digits are zeros.
///
/// They reveal damage and changes by hand. They are no signature: who writes a file anew writes its checksum too.
#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace fretwork::results {

inline constexpr std::size_t user_block_bytes = 512; ///< the shortest that HDF5 knows

/// The user block of an HDF5 file with this content.
[[nodiscard]] std::string user_block(std::string_view hdf5);
/// Why the file may not be read; empty where its checksum fits.
[[nodiscard]] std::string checksum_refusal(const std::filesystem::path& hdf5_file);

/// What stands for the checksum while it is computed.
[[nodiscard]] const std::string& no_checksum();
/// The text of a summary with its checksum in the place of the last `no_checksum()`.
[[nodiscard]] std::string with_checksum(std::string summary);
/// True where the checksum of a summary fits its text.
[[nodiscard]] bool checksum_fits(std::string summary);

} // namespace fretwork::results
