// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Classes of normal force and sliding speed of contacts, which the law kwu_epri takes (wear/kwu_epri.hpp), over every step of a window.
/// A record with a normal force is one sample that counts with the time in contact: the mean force while the contact is closed, and the
/// path of sliding over that time.
#pragma once
#include "transient/run.hpp"
#include "wear/kwu_epri.hpp"
#include <optional>
#include <vector>

namespace fretwork::post {

class ForceSpeedClasses final : public transient::ContactObserver {
public:
  /// @param maxima  N and m/s, > 0, for each contact; nothing: the contact is not watched   @param from  start of the window, s
  /// @throws core::Error for maxima out of range
  ForceSpeedClasses(const std::vector<std::optional<wear::KwuMaxima>>& maxima, double from);
  void step(const transient::Record& record) override;
  void visit(core::StateArchive& state) override {
    for (wear::KwuClasses& of_contact : classes_)
      state(of_contact);
  }
  /// Of the contacts that are watched, in their order.
  [[nodiscard]] const std::vector<wear::KwuClasses>& classes() const { return classes_; }

private:
  static constexpr int none = -1;

  double from_;
  std::vector<int> watched_; ///< by contact: its place in classes_, or none
  std::vector<wear::KwuClasses> classes_;
};

} // namespace fretwork::post
