// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: colours of thin films: reflectance of an interface under a film whose thickness is that of waves of light
//          [Belcour17].

#include "lib/math.glsl"

// Mean over what eyes see of cos(2 pi opd / wavelength + shift), as linear Rec. 709 colour: Fourier transforms of Gaussians that
// fit the observer's curves. opd [nm]
vec3 seen_cosine(float opd, float shift)
{
    float phase = 2.0 * PI * opd * 1e-9, p2 = phase * phase;
    vec3 val = vec3(5.4856e-13, 4.4201e-13, 5.2481e-13), pos = vec3(1.6810e6, 1.7953e6, 2.2084e6);
    vec3 var = vec3(4.3278e9, 9.3046e9, 6.6121e9);
    vec3 xyz = val * sqrt(2.0 * PI * var) * cos(pos * phase + shift) * exp(-var * p2);
    xyz.x += 9.7470e-14 * sqrt(2.0 * PI * 4.5282e9) * cos(2.2399e6 * phase + shift) * exp(-4.5282e9 * p2);
    xyz /= 1.0685e-7;
    return vec3(dot(xyz, vec3(3.2404542, -1.5371385, -0.4985314)), dot(xyz, vec3(-0.9692660, 1.8760108, 0.0415560)),
                dot(xyz, vec3(0.0556434, -0.2040259, 1.0572252)));
}

// Amplitudes that an interface of relative index eta reflects, across and along the plane of incidence; cosine_beyond: of the
// angle to which light is bent, 0 where it is reflected as a whole.
vec2 amplitudes(float cosine, float eta, out float cosine_beyond)
{
    float c2 = 1.0 - (1.0 - cosine * cosine) / (eta * eta);
    cosine_beyond = sqrt(max(c2, 0.0));
    return c2 <= 0.0 ? vec2(1.0) : vec2((cosine - eta * cosine_beyond) / (cosine + eta * cosine_beyond),
                                        (eta * cosine - cosine_beyond) / (eta * cosine + cosine_beyond));
}

// One polarisation: share and sign of what the film's top reflects, share of what its ground does, turned over by `flip` or not.
vec3 film_sum(float top, vec3 ground, float flip, float opd)
{
    float R12 = top * top, T = 1.0 - R12, turn = (top < 0.0 ? 0.0 : PI) + flip;
    vec3 both = R12 * ground, root = sqrt(both), Rs = T * T * ground / (1.0 - min(both, 0.9999)), c = Rs - T, sum = R12 + Rs;
    for (int m = 1; m <= 3; m++) {
        c *= root;
        sum += 2.0 * c * seen_cosine(float(m) * opd, float(m) * turn);
    }
    return sum;
}

// Reflectance at that cosine of a film [nm] over a dielectric of relative index eta.
vec3 film_over_dielectric(float cosine, float thickness, float film_ior, float eta)
{
    float film = thickness < 1.0 ? mix(1.0, film_ior, smoothstep(0.0, 1.0, thickness)) : film_ior, inside, beyond;
    vec2 top = amplitudes(cosine, film, inside), ground = amplitudes(inside, eta / film, beyond);
    if (inside == 0.0 || beyond == 0.0)
        return vec3(1.0);
    float opd = 2.0 * film * thickness * inside;
    vec3 across = film_sum(top.x, vec3(ground.x * ground.x), ground.x < 0.0 ? PI : 0.0, opd);
    vec3 along = film_sum(top.y, vec3(ground.y * ground.y), ground.y < 0.0 ? PI : 0.0, opd);
    return clamp(0.5 * (across + along), 0.0, 1.0);
}

// Shift of waves [rad] at a metal of index n + i k beneath a medium of index `above`: across and along the plane of incidence.
vec2 metal_shift(float cosine, float above, float n, float k)
{
    float c = above * cosine, t = n * n - k * k - above * above * (1.0 - cosine * cosine), nk = 2.0 * n * k;
    float both = sqrt(t * t + nk * nk), u = sqrt(max(0.5 * (both + t), 0.0)), v = sqrt(max(0.5 * (both - t), 0.0)), m = n * n - k * k;
    float across = atan(-2.0 * c * v, c * c - u * u - v * v);
    float along = atan(2.0 * c * (nk * u - m * v), (n * n + k * k) * (n * n + k * k) * cosine * cosine - above * above * (u * u + v * v));
    return vec2(across, along);
}

// The same over a metal that reflects f0 straight on and `edge` at cos = 1/7: its index is the one that would [Kutz21].
vec3 film_over_metal(float cosine, float thickness, float film_ior, vec3 f0, vec3 edge)
{
    float film = thickness < 1.0 ? mix(1.0, film_ior, smoothstep(0.0, 1.0, thickness)) : film_ior, inside;
    vec2 top = amplitudes(cosine, film, inside);
    if (inside == 0.0)
        return vec3(1.0);
    float opd = 2.0 * film * thickness * inside, f5 = pow(6.0 / 7.0, 5.0);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < 3; i++) {
        float r = min(f0[i], 0.999), root = sqrt(r), n = mix((1.0 + root) / (1.0 - root), (1.0 - r) / (1.0 + r), edge[i]);
        float k = sqrt(max((r * (n + 1.0) * (n + 1.0) - (n - 1.0) * (n - 1.0)) / (1.0 - r), 0.0));
        float nf = n / film, kf = k / film, own = ((nf - 1.0) * (nf - 1.0) + kf * kf) / ((nf + 1.0) * (nf + 1.0) + kf * kf);
        float dip = (mix(own, 1.0, f5) - edge[i]) * 7.0 / (f5 * 6.0 / 7.0), m = 1.0 - inside, m5 = m * m * m * m * m;
        vec3 ground = vec3(clamp(mix(own, 1.0, m5) - dip * inside * m5 * m, 0.0, 1.0));
        vec2 shift = metal_shift(inside, film, n, k);
        sum[i] = 0.5 * (film_sum(top.x, ground, shift.x, opd)[i] + film_sum(top.y, ground, shift.y, opd)[i]);
    }
    return clamp(sum, 0.0, 1.0);
}
