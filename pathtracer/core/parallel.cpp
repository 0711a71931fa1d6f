#include "core/parallel.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/task_arena.h>

#include "task_order.h"

namespace pt {

namespace {
int threadCount(int requested) {
  return requested > 0 ? requested : tbb::this_task_arena::max_concurrency();
}

void runIn(guiding::TaskOrder& order, const std::function<void()>& work) {
  const guiding::TaskOrder::Task task(order);
  work();
}
}  // namespace

void parallelFor(std::size_t count, const std::function<void(std::size_t)>& task) {
  guiding::TaskOrder order;
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, count, 1),
      [&](const tbb::blocked_range<std::size_t>& range) {
        const guiding::TaskOrder::Task ordered(order);
        for (std::size_t i = range.begin(); i != range.end(); ++i) task(i);
      },
      tbb::simple_partitioner());
}

struct Workers::Impl {
  explicit Impl(int threads)
      : limit(tbb::global_control::max_allowed_parallelism, std::size_t(threads)), arena(threads) {}

  tbb::global_control limit;  // oneTBB starts no more threads than cores unless it is allowed to
  tbb::task_arena arena;
};

Workers::Workers(int threads) : m_impl(std::make_unique<Impl>(threadCount(threads))) {}
Workers::~Workers() = default;

int Workers::count() const noexcept {
  return m_impl->arena.max_concurrency();
}

void Workers::forEach(std::size_t count, const std::function<void(std::size_t, int)>& task) {
  execute([&] { parallelFor(count, [&](std::size_t i) { task(i, tbb::this_task_arena::current_thread_index()); }); });
}

void Workers::execute(const std::function<void()>& work) {
  guiding::TaskOrder order;
  m_impl->arena.execute([&] { runIn(order, work); });
}

void Workers::invoke(const std::function<void()>& first, const std::function<void()>& second) {
  execute([&] {
    guiding::TaskOrder order;
    tbb::parallel_invoke([&] { runIn(order, first); }, [&] { runIn(order, second); });
  });
}

}  // namespace pt
