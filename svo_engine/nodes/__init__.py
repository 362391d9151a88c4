# SPDX-License-Identifier: GPL-3.0-or-later
"""Node trees -> GLSL and values: numpy only, text out.

    tree        what feeds what: groups, reroutes and muted nodes are gone
    kinds/      what each kind of node means: a function of a `Reader`
    expr        the expressions that kinds make; what is constant is computed at once, by `twins`
    closures    mixtures of shaders as a weight for each closure
    ramps       ramps and curves as tables; `spectra` likewise the colours of light
    signatures  the functions of shaders/nodes, read from their GLSL
    emit        expressions as GLSL
    compile     all materials of a scene: few structures, and values for each material
"""
