// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What may go wrong. Wrong input throws Error (the message names the object, its value and the cure); a
/// computation that cannot give a result throws ComputationError. A defect of the program is an assert. Only
/// `main` catches.
#pragma once
#include <stdexcept>

namespace fretwork::core {

/// The input is wrong: exit status 1.
class Error : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// The computation failed although the input was well-formed (no convergence, divergence): exit status 2.
class ComputationError : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// SIGTERM, SIGINT or SIGHUP has ended the computation; the same command goes on: exit status 2.
class Interrupted : public ComputationError {
public:
  using ComputationError::ComputationError;
};

} // namespace fretwork::core
