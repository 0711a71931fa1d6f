#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <cstddef>

#include "task_order.h"

namespace guiding {

/// Calls body(i) for each i below `count` in the caller's task arena, in chunks of about `grain`.
///
/// The work is the library's own: a host that cancels its tasks does not cut it short, a thread that waits for its end
/// does not take up other tasks of the host (which might wait for a lock that the caller holds), and all threads round
/// as the caller's does.
template <class Body>
void parallelFor(std::size_t count, std::size_t grain, const Body& body) {
  TaskOrder order;
  tbb::this_task_arena::isolate([&] {
    tbb::task_group_context context(tbb::task_group_context::isolated,
                                    tbb::task_group_context::default_traits | tbb::task_group_context::fp_settings);
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, count, grain),
        [&](const tbb::blocked_range<std::size_t>& range) {
          const TaskOrder::Task task(order);
          for (std::size_t i = range.begin(); i != range.end(); ++i) body(i);
        },
        context);
  });
}

}  // namespace guiding
