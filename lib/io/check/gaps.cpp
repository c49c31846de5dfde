#include "esi/io/check/gaps.hpp"

#include <algorithm>

namespace esi {
namespace {

bool is_longer(const Interval& a, const Interval& b) { return a.duration_us() > b.duration_us(); }

}  // namespace

void Gaps::add(std::span<const Event> events) {
  for (const Event& event : events) {
    const Interval gap{previous_us_.value_or(event.t_us), event.t_us};
    previous_us_ = event.t_us;
    if (longest_.size() == kMost && !is_longer(gap, longest_.front())) continue;
    longest_.push_back(gap);
    std::push_heap(longest_.begin(), longest_.end(), is_longer);
    if (longest_.size() <= kMost) continue;
    std::pop_heap(longest_.begin(), longest_.end(), is_longer);
    longest_.pop_back();
  }
}

std::vector<Interval> Gaps::longer_than(std::int64_t limit_us) const {
  std::vector<Interval> gaps;
  std::copy_if(longest_.begin(), longest_.end(), std::back_inserter(gaps),
               [limit_us](const Interval& gap) { return gap.duration_us() > limit_us; });
  std::sort(gaps.begin(), gaps.end(),
            [](const Interval& a, const Interval& b) { return a.begin_us < b.begin_us; });
  return gaps;
}

}  // namespace esi
