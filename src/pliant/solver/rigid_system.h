#pragma once
// The equations of components that push each other and move as rigid bodies, all at once: a symmetric matrix with a
// block of six rows for each, and Cholesky's factor of it.
#include <span>
#include <vector>

#include "pliant/core/types.h"

namespace pliant {

/// Two bodies that push each other, by number, the first the smaller one.
struct RigidLink {
  std::size_t first = 0, second = 0;

  bool operator==(const RigidLink&) const = default;
};

/// Sets of bodies that links connect are each factorized by itself, with the bodies of least degree eliminated first.
/// Blocks below the diagonal that are filled are known from the links, and are laid out again only when these change.
class RigidSystem {
 public:
  using Matrix = Eigen::Matrix<Real, 6, 6>;
  using Vector = Eigen::Matrix<Real, 6, 1>;

  /// Of so many bodies. Links are all different.
  void lay_out(std::size_t count, std::span<const RigidLink> links);
  std::size_t set_count() const { return sets_.size(); }
  /// Bodies of a set, ascending.
  std::span<const std::size_t> bodies(std::size_t set) const { return sets_[set].bodies; }
  /// Links of it, by number.
  std::span<const std::size_t> links(std::size_t set) const { return sets_[set].links; }
  /// Whether it is worth a factor. None of others is to be put together.
  bool is_small(std::size_t set) const;

  /// Puts a set's matrix together: zero, then blocks of bodies, and of links m₁ᵀ C m₂.
  void begin(std::size_t set);
  void set_body(std::size_t body, const Matrix& block) { diagonal_[places_[body]] = block; }
  void set_link(std::size_t link, const Matrix& block);
  /// Factorizes it. Returns whether it is positive definite.
  bool factorize(std::size_t set);
  /// x ← A⁻¹ x, a vector for each body of all.
  void solve(std::size_t set, std::span<Vector> x) const;

 private:
  /// Eliminated one after the other, each with the rows of the blocks below its own.
  struct Set {
    std::vector<std::size_t> bodies, links;
    std::size_t first = 0;             // place of the body that is eliminated first; the others follow
    std::vector<std::size_t> targets;  // of the products, in their order: blocks, or diagonal ones
  };

  void find_sets();
  void eliminate(Set& set, std::vector<std::vector<std::size_t>>& neighbors);
  std::vector<std::size_t> order_of(const Set& set, std::vector<std::vector<std::size_t>>& neighbors) const;
  std::size_t block_of(std::size_t row, std::size_t column) const;

  std::size_t count_ = 0;
  std::vector<RigidLink> links_;
  std::vector<Set> sets_;
  std::vector<std::size_t> places_;       // of each body, in the order of elimination
  std::vector<std::size_t> order_;        // and the other way round
  std::vector<std::size_t> starts_;       // of each place, its first block; one more at the end
  std::vector<std::size_t> rows_;         // of each block, a place
  std::vector<std::size_t> link_blocks_;  // of each link
  std::vector<Matrix> diagonal_, blocks_;
};

}  // namespace pliant
