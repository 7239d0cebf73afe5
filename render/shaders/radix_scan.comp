// Counts -> the sums of those before each. One workgroup.

layout(local_size_x = 1024) in;
layout(location = 0) uniform uint count;

layout(std430, binding = 1) buffer Counts { uint counts[]; };

shared uint sums[1024];

void main() {
    const uint own = gl_LocalInvocationID.x;
    const uint each = (count + 1023u) / 1024u;
    const uint first = min(own * each, count), end = min(first + each, count);
    uint sum = 0u;
    for (uint i = first; i < end; ++i) sum += counts[i];
    sums[own] = sum;
    barrier();
    for (uint by = 1u; by < 1024u; by *= 2u) {
        const uint before = own >= by ? sums[own - by] : 0u;
        barrier();
        sums[own] += before;
        barrier();
    }
    uint before = sums[own] - sum;
    for (uint i = first; i < end; ++i) {
        const uint here = counts[i];
        counts[i] = before;
        before += here;
    }
}
