// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The study file as a tree of values, overrides applied, nothing checked yet but that it is TOML.
#pragma once
#include "study/value.hpp"
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace fretwork::study {

struct Study;

struct Document {
  std::filesystem::path file; ///< absolute
  std::string text;           ///< as read
  Value root;                 ///< a table
};

/// A study file as it stands. Where it has `sweep.study`, all but `[sweep]` is taken from the study named there.
/// @throws core::Error if the file cannot be read or is not TOML
[[nodiscard]] Document parse(const std::filesystem::path& file);

/// Apply overrides (`key=value`), in their order, then the defaults of contacts.
/// @throws core::Error if an override has no valid address or value
void complete(Document& document, const std::vector<std::string>& overrides);

/// Both: what a study says.
[[nodiscard]] Document load(const std::filesystem::path& file, const std::vector<std::string>& overrides);

/// Whether the values remember their lines: an override has none.
enum class Lines { kept, none };

/// TOML text as a tree of values; `origin` names the source in messages.
/// @throws core::Error naming the line and what is wrong
[[nodiscard]] Value parse_toml(std::string_view text, std::shared_ptr<const std::string> origin,
                               Lines lines = Lines::kept);

/// The parts of an address, which dots outside double quotes separate; none where a quote is not closed.
[[nodiscard]] std::vector<std::string> address_parts(const std::string& address);

/// What a message adds where a part of an address is the name of one node's results, as `support[0]` of an entry of [[contacts]] whose group
/// has several nodes; else empty.
[[nodiscard]] std::string help_on_nodes(const Array& contacts, const std::string& part);

/// Apply one override to the tree. The address is split at dots; a part with dots in it is put between double
/// quotes. An entry of an array of tables is found by its name, else its group, else its index from 0. The
/// last part may be a new key of an existing table; the tables [mesh], [modes], [contact_defaults], [gravity], [transient]
/// and [output] are made where the study has none.
/// @throws core::Error for an address that leads nowhere (listing what exists) and for a value that is not
/// TOML
void apply_override(Value& root, const std::string& override_text);

/// Give every entry of [[contacts]] the keys of [contact_defaults] that it does not have, nor another key in their stead, and take the table
/// away.
/// @throws core::Error for keys of one contact (name, group, other) and where there is no contact
void apply_contact_defaults(Value& root);

/// Read and check a completed document; `overrides` are those that were applied, for the results.
/// @throws core::Error as read of a file
[[nodiscard]] Study read(const Document& document, const std::vector<std::string>& overrides);

} // namespace fretwork::study
