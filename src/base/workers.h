#pragma once
// The threads of the program: a fixed set of workers, made once and handed to whatever can use more than one
// core.
//
// Results never depend on the number of workers: work is cut into chunks by its size alone, every chunk
// writes its own outputs, and sums over chunks are taken in the order of the chunks.

#include <cstddef>
#include <memory>
#include <type_traits>

namespace knead {

class Workers {
public:
    // `threads` ≥ 1 counts the calling thread; 0 takes one a core.
    explicit Workers(unsigned threads = 0);
    ~Workers();
    Workers(const Workers&) = delete;
    Workers& operator=(const Workers&) = delete;

    unsigned threads() const;

    // Calls work(begin, end) for consecutive ranges of `grain` indices (the last may be shorter) that cover 0
    // … count, in any order, on all workers, and returns when all are done. The first exception that `work`
    // throws is thrown here. Calls do not nest, and one thread at a time may call. Allocates nothing.
    template<typename Work>
    void for_chunks(std::size_t count, std::size_t grain, Work&& work) {
        using Plain = std::remove_reference_t<Work>;
        auto call = [](void* context, std::size_t begin, std::size_t end) {
            (*static_cast<Plain*>(context))(begin, end);
        };
        run(count, grain, call, const_cast<void*>(static_cast<const void*>(std::addressof(work))));
    }

    // Calls work(i) for every i in 0 … count.
    template<typename Work>
    void for_each(std::size_t count, std::size_t grain, Work&& work) {
        for_chunks(count, grain, [&work](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) work(i);
        });
    }

private:
    using Call = void (*)(void* context, std::size_t begin, std::size_t end);
    void run(std::size_t count, std::size_t grain, Call call, void* context);

    struct State;
    std::unique_ptr<State> state_;
};

} // namespace knead
