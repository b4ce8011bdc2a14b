#pragma once
// The stretches nearest to given ones whose product is given: what areas and volumes are projected with.
//
//     min Σ (gᵢ − σᵢ)²  so that  Π gᵢ = t        stationary where gᵢ (σᵢ − gᵢ) = μ for all i
//
// A matrix nearest to U diag(σ) Vᵀ among those of determinant t is U diag(g) Vᵀ with g sorted as σ, so it is enough to
// know σ. Several g are stationary where an element is stretched to many times its volume; the nearest is found.
//
// Source: Bouaziz et al. 2014, Sec. 5.1, which takes some local minimum.
#include "pliant/core/types.h"

namespace pliant {

/// g₁ ≥ g₂ > 0 of product t > 0 nearest to σ₁ ≥ σ₂ ≥ 0.
Vec2 nearest_of_product(const Vec2& sigma, Real product);

/// g₁ ≥ g₂ ≥ g₃ > 0 of product t > 0 nearest to σ₁ ≥ σ₂ ≥ |σ₃|, σ₃ < 0 where an element is inverted.
Vec3 nearest_of_product(const Vec3& sigma, Real product);

/// `sigma` itself where its product is from min to max, else the nearest such stretches.
template <class Sigma>
Sigma with_product_between(const Sigma& sigma, Real min, Real max) {
  Real product = 1;  // the smallest first, so that it is finite if it can be
  for (Eigen::Index i = sigma.size() - 1; i >= 0; --i) product *= sigma[i];
  if (product < min) return nearest_of_product(sigma, min);
  if (product > max) return nearest_of_product(sigma, max);
  return sigma;
}

}  // namespace pliant
