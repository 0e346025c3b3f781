// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The tubes of each fluidelastic law on the modes of their structures.
#pragma once
#include "app/flow_damping.hpp"
#include "flow/fluidelastic.hpp"

namespace fretwork::app {

/// Unknowns of modes and lags whose roots are searched: their eigenvalues take a second.
inline constexpr Eigen::Index most_searched = 600;

/// The tubes of a law, one or several that it couples, on the modes of their structures one after the other.
struct TubesOfLaw {
  std::string name; ///< for messages
  const flow::FluidelasticLaw& law;
  std::vector<std::size_t> flows;      ///< numbers in TubesInFlow::flows
  std::vector<std::size_t> structures; ///< numbers, ascending
  std::vector<Eigen::Index> first;     ///< mode of each structure among those of all
  Eigen::Index modes;                  ///< of all, static ones too
  std::vector<flow::TubeOfLaw> tubes;
};

/// By laws and, where a law is of one tube, by tubes; nothing where no flow has a law.
/// @throws core::Error for a tube that belongs to no structure
[[nodiscard]] std::vector<TubesOfLaw> tubes_of_laws(const TubesInFlow& tubes,
                                                    const std::vector<modal::Basis>& bases);

/// The vibration modes of lowest frequency alone, so many of each structure at most.
[[nodiscard]] TubesOfLaw lowest(TubesOfLaw of, const std::vector<modal::Basis>& bases, Eigen::Index most);

/// Where V is largest.
struct Fastest {
  double velocity = 0.0, diameter = 1.0; ///< m/s, m
};
[[nodiscard]] Fastest fastest(const TubesOfLaw& of);

/// @param factor  the largest
/// @throws core::Error what flow::forces_over_factor throws, named by the law's tubes
[[nodiscard]] flow::ForcesOverFactor forces_of(const TubesOfLaw& of, double factor);

} // namespace fretwork::app
