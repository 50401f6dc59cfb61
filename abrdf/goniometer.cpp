// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/goniometer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace abrdf {

namespace {

constexpr Radians kRounding = 1e-9;

/// Turned into -pi .. pi.
Radians shortestTurn(Radians angle) {
    return std::remainder(angle, 2 * kPi);
}

bool isPole(Direction direction) {
    return direction.theta < kRounding;
}

/// The samples of a closed slice once round.
std::vector<std::size_t> roundOf(const std::vector<LightAndView>& slice) {
    std::vector<std::size_t> round(slice.size());
    std::iota(round.begin(), round.end(), std::size_t{0});
    std::ranges::stable_sort(
        round, [&](std::size_t i, std::size_t j) { return slice[i].view.phi < slice[j].view.phi; });
    return round;
}

/// The same from a start, forth or back: the two leave out different gaps.
std::vector<std::size_t> shorterWay(const std::vector<LightAndView>& slice,
                                    const std::vector<std::size_t>& round, std::size_t start,
                                    const Goniometer& goniometer) {
    std::vector<std::size_t> forth;
    std::vector<std::size_t> back;
    for (std::size_t k = 0; k < round.size(); ++k) {
        forth.push_back(round[(start + k) % round.size()]);
        back.push_back(round[(start + round.size() - k) % round.size()]);
    }
    const auto costOf = [&](const std::vector<std::size_t>& way) {
        Goniometer ahead = goniometer;
        Radians cost = 0;
        for (const std::size_t i : way) cost += ahead.moveTo(slice[i]).sum();
        return cost;
    };
    return costOf(back) < costOf(forth) - kRounding ? back : forth;
}

}  // namespace

Goniometer::Move Goniometer::moveOf(const LightAndView& pair) const {
    Move move{now_, {}};
    move.end.thetaLight = pair.light.theta;
    move.end.thetaSensor = pair.view.theta;
    if (!isPlaced_) {
        move.end.azimuthLight = pair.light.phi;
        move.end.azimuthSensor = pair.view.phi;
        return move;
    }
    // With the sample turned by p, light and sensor turn by a + p and b + p. |a + p| + |b + p| +
    // |p| is least where p is the median of -a, -b and 0.
    const Radians a = shortestTurn(pair.light.phi - now_.azimuthLight + now_.turn);
    const Radians b = shortestTurn(pair.view.phi - now_.azimuthSensor + now_.turn);
    Radians least = 1e9;
    Radians light = 0;
    Radians sensor = 0;
    Radians sample = 0;
    for (const Radians roundA : {0.0, 2 * kPi, -2 * kPi}) {
        for (const Radians roundB : {0.0, 2 * kPi, -2 * kPi}) {
            // At the pole an azimuth is as good as any other: the light stays, or the sensor.
            std::array<Radians, 3> turns = {-(a + roundA), -(b + roundB), 0};
            if (isPole(pair.light)) turns[0] = turns[1];
            if (isPole(pair.view)) turns[1] = turns[0];
            if (isPole(pair.light) && isPole(pair.view)) turns = {};
            std::array<Radians, 3> sorted = turns;
            std::ranges::sort(sorted);
            const Radians p = sorted[1];
            const Radians ofLight = isPole(pair.light) ? 0 : p - turns[0];
            const Radians ofSensor = isPole(pair.view) ? 0 : p - turns[1];
            const Radians sum = std::abs(ofLight) + std::abs(ofSensor) + std::abs(p);
            if (sum > least - kRounding) continue;
            least = sum;
            light = ofLight;
            sensor = ofSensor;
            sample = p;
        }
    }
    move.end.azimuthLight = now_.azimuthLight + light;
    move.end.azimuthSensor = now_.azimuthSensor + sensor;
    move.end.turn = now_.turn + sample;
    move.travel = {std::abs(light) + std::abs(pair.light.theta - now_.thetaLight),
                   std::abs(sensor) + std::abs(pair.view.theta - now_.thetaSensor),
                   std::abs(sample)};
    return move;
}

Travel Goniometer::moveTo(const LightAndView& pair) {
    const Move move = moveOf(pair);
    now_ = move.end;
    isPlaced_ = true;
    return move.travel;
}

Travel travelOf(std::span<const LightAndView> pairs) {
    Goniometer goniometer;
    Travel travel;
    for (const LightAndView& pair : pairs) travel += goniometer.moveTo(pair);
    return travel;
}

std::vector<std::size_t> sweptOrder(const std::vector<std::vector<LightAndView>>& slices) {
    std::vector<std::vector<std::size_t>> rounds;
    std::vector<std::size_t> offsets;
    std::size_t total = 0;
    for (const std::vector<LightAndView>& slice : slices) {
        rounds.push_back(roundOf(slice));
        offsets.push_back(total);
        total += slice.size();
    }
    std::vector<std::size_t> order;
    std::vector<bool> isDone(slices.size(), false);
    Goniometer goniometer;
    for (std::size_t step = 0; step < slices.size(); ++step) {
        std::size_t slice = slices.size();
        std::size_t start = 0;
        Radians least = 0;
        for (std::size_t s = 0; s < slices.size(); ++s) {
            if (isDone[s]) continue;
            for (std::size_t k = 0; k < rounds[s].size(); ++k) {
                const Radians cost = goniometer.travelTo(slices[s][rounds[s][k]]).sum();
                if (slice != slices.size() && cost > least - kRounding) continue;
                least = cost;
                slice = s;
                start = k;
            }
        }
        if (slice == slices.size()) break;  // Only empty ones are left.
        isDone[slice] = true;
        for (const std::size_t i : shorterWay(slices[slice], rounds[slice], start, goniometer)) {
            goniometer.moveTo(slices[slice][i]);
            order.push_back(offsets[slice] + i);
        }
    }
    return order;
}

}  // namespace abrdf
