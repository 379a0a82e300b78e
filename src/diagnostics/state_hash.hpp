#pragma once
// A number that tells whether two states are the same, bit for bit, whoever owns the particles.

#include <bit>
#include <cstdint>
#include <initializer_list>

namespace sphdrop {

/// All that a particle carries from step to step, SI units; the stress of a fluid particle is zero.
struct HashedParticle {
  std::int64_t id = 0;
  double x = 0, y = 0, velocity_x = 0, velocity_y = 0, density = 0;
  double stress_xx = 0, stress_yy = 0, stress_xy = 0;
};

/// The finaliser of splitmix64 (Steele, Lea & Flood 2014): one to one, and every bit in moves about half the bits out.
constexpr std::uint64_t avalanche(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31);
}

/// A particle's contribution. The state's hash is the sum over all particles modulo 2^64, so it depends neither on
/// their order nor on who owns them. Bits count as they are: -0.0 is not 0.0. Each link of the chain is one to one, so
/// states of one particle that differ in a single field never have the same contribution.
constexpr std::uint64_t particle_hash(const HashedParticle& particle) {
  constexpr std::uint64_t increment = 0x9e3779b97f4a7c15U;
  std::uint64_t hash = avalanche(static_cast<std::uint64_t>(particle.id) + increment);
  for (const double value : {particle.x, particle.y, particle.velocity_x, particle.velocity_y, particle.density,
                             particle.stress_xx, particle.stress_yy, particle.stress_xy})
    hash = avalanche((hash ^ std::bit_cast<std::uint64_t>(value)) + increment);
  return hash;
}

}  // namespace sphdrop
