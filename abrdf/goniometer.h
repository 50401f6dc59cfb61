// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/direction.h"

#include <cstddef>
#include <span>
#include <vector>

namespace abrdf {

/// How far the parts of a goniometer turn: light and sensor about two axes each, the sum of their
/// changes of theta and of azimuth; the sample about its normal.
struct Travel {
    Radians light = 0;
    Radians sensor = 0;
    Radians sample = 0;

    Radians sum() const { return light + sensor + sample; }
    Travel& operator+=(const Travel& other) {
        light += other.light;
        sensor += other.sensor;
        sample += other.sample;
        return *this;
    }
};

/// A goniometer that goes from one pair of directions to the next. Azimuths are those of the
/// sample, which turns as well: of all ways it takes the one whose three azimuths turn the least in
/// sum, so that along an axial slice only the sample turns, along a diagonal one light and sensor.
/// It first stands where it is first told to go; no axis has a stop.
class Goniometer {
  public:
    /// What moveTo() would cost.
    Travel travelTo(const LightAndView& pair) const { return moveOf(pair).travel; }
    Travel moveTo(const LightAndView& pair);

  private:
    struct State {
        Radians thetaLight, azimuthLight, thetaSensor, azimuthSensor, turn;
    };
    struct Move {
        State end;
        Travel travel;
    };
    Move moveOf(const LightAndView& pair) const;

    State now_ = {};
    bool isPlaced_ = false;
};

/// Over all pairs in their order.
Travel travelOf(std::span<const LightAndView> pairs);

/// An order of all samples of closed slices in which a goniometer travels little: slice after
/// slice, each once round by the azimuth of its views; next is always the one whose nearest end
/// costs least. Slice s is slices[s]; the result counts the samples of all, one slice after the
/// other.
std::vector<std::size_t> sweptOrder(const std::vector<std::vector<LightAndView>>& slices);

}  // namespace abrdf
