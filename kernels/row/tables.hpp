// SPDX-License-Identifier: Apache-2.0
// The tables that are compiled in, and the parts they are made of; select.cpp asks the processor which may run.
#pragma once
#include "kernels/row/kernel_table.hpp"

namespace evigrid::kernels {
const KernelTable& avx2_table() noexcept;
const KernelTable& avx512_table() noexcept;

namespace scalar {
void fill_pcr(KernelTable&);     // PCR2, PCR5, GERM-PCR2
void fill_pcr14(KernelTable&);   // PCR1, PCR4
void fill_states(KernelTable&);  // rules whose state is not (e, o, u)
}  // namespace scalar
namespace avx2 {
void fill_pcr(KernelTable&);
void fill_pcr14(KernelTable&);
void fill_states(KernelTable&);
}  // namespace avx2
namespace avx512 {
void fill_pcr(KernelTable&);
void fill_pcr14(KernelTable&);
void fill_states(KernelTable&);
}  // namespace avx512
// The batched combination: one vector at a time, in namespaces of their own (batch.hpp).
namespace scalar {
void fill_batch(KernelTable&);
}
namespace avx2_batch {
void fill_batch(KernelTable&);
}
namespace avx512_batch {
void fill_batch(KernelTable&);
}
}  // namespace evigrid::kernels
