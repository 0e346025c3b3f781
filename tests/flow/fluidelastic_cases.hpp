// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Tubes and laws of which reference values are known: a metre of tube, and a pinned tube.
#pragma once
#include "fem/gauss.hpp"
#include "flow/fluidelastic.hpp"
#include <cmath>
#include <limits>
#include <numbers>

namespace fluidelastic_test {

using namespace fretwork;
using namespace fretwork::flow;

inline constexpr double diameter = 0.01905; // m
inline constexpr double no_limit =
    std::numeric_limits<double>::infinity(); // of the velocity: memory for every mode

struct OneDof {
  double mass, frequency, damping, density;
};
inline constexpr OneDof s1{0.9, 20.0, 0.01, 300.0}, c1{1.1, 30.0, 0.005, 1000.0};

inline FluidelasticLaw law_s1() {
  FluidelasticLaw law;
  law.stiffness(1, 1) = -4.0;
  law.damping(1, 1) = -0.4;
  law.lags = {{0.4, Eigen::Vector2cd(0.0, 4.0).asDiagonal().toDenseMatrix()}};
  return law;
}

inline MeasuredForce a1(double x) { // a cell of flexible tubes
  return {x, 88.73 - 637.1517 / x + 1398.2465 / (x * x) - 867.31 / std::pow(x, 3),
          -0.225 + 2.417 / x - 0.458 / (x * x)};
}
inline MeasuredForce a3(double x) { // one flexible tube in a rigid bundle
  return {x, -0.0796 + 7.95 / x - 21.49 / (x * x),
          2.06 - 20.68 / x + 54.45 / (x * x) - 14.8 / std::pow(x, 3) - 53.6 / std::pow(x, 4)};
}

/// One metre of tube that moves along lift, at one station.
inline Sampling metre(const OneDof& of, double velocity) {
  Sampling out;
  out.frequency = Eigen::VectorXd::Constant(1, of.frequency);
  out.modal_mass = Eigen::VectorXd::Ones(1);
  out.zones = 1;
  Station station;
  station.weight = 1.0;
  station.tube.outer_diameter = diameter;
  station.flow.zone = 0;
  station.flow.velocity = velocity;
  station.flow.density = of.density;
  station.flow.drag = Vec3::UnitX();
  station.flow.lift = Vec3::UnitY();
  station.shapes = Vec3::UnitY() / std::sqrt(of.mass);
  out.stations = {station};
  return out;
}

/// Pinned tube, L 1 m, shapes sqrt(2/(m L)) sin(k pi s/L) along lift, flow from L/4 to 3 L/4: 200 midpoints do not do, so Gauss of 8 points on
/// 24 equal parts.
inline Sampling pinned(Eigen::Index modes, double from, double to) {
  constexpr double mass = 1.0993164814, first = 33.425241258;
  constexpr int parts = 24;
  Sampling out = metre(s1, 1.0);
  const Station like = out.stations[0];
  out.stations.clear();
  out.frequency.resize(modes);
  for (Eigen::Index k = 0; k < modes; ++k)
    out.frequency(k) = first * static_cast<double>((k + 1) * (k + 1));
  out.modal_mass = Eigen::VectorXd::Ones(modes);
  const double width = (to - from) / parts;
  for (int part = 0; part < parts; ++part)
    for (const auto& [share, weight] : fem::gauss_points) {
      Station station = like;
      const double s = from + (part + share) * width;
      station.weight = weight * width;
      station.shapes = Eigen::Matrix3Xd::Zero(3, modes);
      for (Eigen::Index k = 0; k < modes; ++k)
        station.shapes(1, k) =
            std::sqrt(2.0 / mass) * std::sin(static_cast<double>(k + 1) * std::numbers::pi * s);
      out.stations.push_back(std::move(station));
    }
  return out;
}

} // namespace fluidelastic_test
