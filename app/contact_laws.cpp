// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/contact_laws.hpp"
#include "contact/restitution.hpp"
#include "core/error.hpp"
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace fretwork::app {
namespace {

contact::NormalLaw normal_law(const study::Contact& contact, const PlacedContact& placed,
                              const contact::Obstacle& obstacle, const Eigen::MatrixXd& b) {
  contact::NormalLaw law{placed.normal_stiffness, contact.normal_damping, contact.normal_dissipation};
  if (!contact.restitution)
    return law;
  const study::Restitution& wanted = *contact.restitution;
  switch (contact.normal_damper) {
  case study::NormalDamper::reference: {
    const double mass = wanted.mass ? *wanted.mass : normal_mass(obstacle, b, placed.name);
    law.damping = contact::damping_of_restitution(wanted.value, law.stiffness, mass);
    return law;
  }
  case study::NormalDamper::hunt_crossley:
    law.dissipation = contact::dissipation_of_restitution(wanted.value, wanted.velocity);
    return law;
  }
  return law;
}

/// R5.06.03 section 6.5 with the mode that moves the contact most along its tangents, in mass-normalised
/// local quantities; of the directions in which friction acts.
double automatic_damping(const study::Contact& contact, const std::string& name,
                         const vibration::System& system, const contact::Obstacle& obstacle,
                         const Eigen::MatrixXd& b) {
  const std::array<bool, 3> directions = contact::friction_directions(obstacle, contact.friction_along);
  Eigen::VectorXd size2 = Eigen::VectorXd::Zero(b.cols());
  for (Eigen::Index k = 0; k < 3; ++k)
    if (directions[static_cast<std::size_t>(k)])
      size2 += b.row(k).cwiseAbs2();
  Eigen::Index mode = 0;
  const double largest = size2.size() > 0 ? size2.maxCoeff(&mode) : 0.0;
  if (!(largest > 0.0))
    throw core::Error(fmt::format(
        "contact \"{}\": no mode moves its node along the obstacle, so that there is no automatic tangential "
        "damping; give tangential_damping a value",
        name));
  const double mass = 1.0 / largest;
  const double omega = std::sqrt(system.stiffness(mode));
  const double ratio = omega > 0.0 ? 0.5 * system.damping(mode) / omega : 0.0;
  const double damping =
      contact::automatic_tangential_damping(contact.tangential_stiffness, omega * omega * mass, mass, ratio);
  if (damping < 0.0)
    throw core::Error(fmt::format("modes.damping: the mode at {:.4g} Hz has a ratio of {:.3g} and does not "
                                  "oscillate (0.02 is 2 % of critical damping); it "
                                  "moves contact \"{}\" most, whose automatic tangential damping would be "
                                  "{:.4g} N s/m, below 0: lower the "
                                  "ratio, or give tangential_damping a value",
                                  omega / (2.0 * std::numbers::pi), ratio, name, damping));
  return damping;
}

contact::FrictionLaw friction_law(const study::Contact& contact, const std::string& name,
                                  const vibration::System& system, const contact::Obstacle& obstacle,
                                  const Eigen::MatrixXd& b) {
  if (!(contact.friction_static > 0.0))
    return {};
  contact::FrictionLaw law;
  law.stiffness = contact.tangential_stiffness;
  law.mu_static = contact.friction_static;
  law.mu_dynamic = contact.friction_dynamic;
  law.kind = contact.memory;
  law.along = contact.friction_along;
  law.damping = contact.tangential_damping ? *contact.tangential_damping
                                           : automatic_damping(contact, name, system, obstacle, b);
  return law;
}

} // namespace

double normal_mass(const contact::Obstacle& obstacle, const Eigen::MatrixXd& b, const std::string& name) {
  const auto [ny, nz] = contact::normal_directions(obstacle);
  const double y = ny ? b.row(1).squaredNorm() : 0.0, z = nz ? b.row(2).squaredNorm() : 0.0;
  const double mobility = (y + z) / (ny && nz ? 2.0 : 1.0);
  if (!(mobility > 0.0))
    throw core::Error(
        fmt::format("contact \"{}\": no mode moves it across its obstacle, so that it feels no "
                    "mass; give restitution_mass (kg), or normal_damping instead of restitution",
                    name));
  return 1.0 / mobility;
}

contact::Support support_of(const study::Contact& contact, const PlacedContact& placed,
                            const vibration::System& system, const Eigen::MatrixXd& b) {
  contact::Support support{placed.obstacle, {}, {}};
  support.normal = normal_law(contact, placed, support.obstacle, b);
  support.friction = friction_law(contact, placed.name, system, support.obstacle, b);
  support.normal.stiffness *= placed.share;
  support.normal.damping *= placed.share; // the dissipation is per stiffness: it takes its share from that
  support.friction.stiffness *= placed.share;
  support.friction.damping *= placed.share;
  return support;
}

} // namespace fretwork::app
