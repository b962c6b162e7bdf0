// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

class QThreadPool;

namespace batten {

/// How many threads the window needs at once when it starts: those that Qt waits for without end where the system does
/// not start them, and one for the work.
int threadsOfStart();
/// Whether the system starts `count` threads at once. They have ended when this returns.
bool canStartThreads(int count);

/// How many of the wanted threads were started.
enum class PaintingThreads {
  None,  ///< Nothing can be painted.
  Some,
  All
};
/// Qt paints wide areas on the threads of a pool, which end when idle; where the system then starts none anew, painting
/// waits for it without end. Starts those of `pool` now and keeps them, a few at most. To be called before anything is
/// painted. Unless all were started the pool must never be destroyed: it would wait for the others without end.
PaintingThreads keepPaintingThreads(QThreadPool& pool);

}  // namespace batten
