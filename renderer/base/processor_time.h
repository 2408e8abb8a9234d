// Processor time of the threads of this process.
#pragma once

#include <vector>

namespace si {

/// Kernel id of a thread of this process, as gettid() returns it.
using ThreadId = int;

/// Returns the ids of all threads of this process except the calling one. Empty where the system does not list threads.
std::vector<ThreadId> other_threads();

/// Returns the processor time that a thread has used, milliseconds. 0 for a thread that has ended.
double processor_ms(ThreadId thread);

/// Returns the processor time that the calling thread has used, milliseconds.
double own_processor_ms();

}  // namespace si
