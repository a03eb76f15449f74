# `cmake --install` comes with the rooms; see base/, weather/, texproc/, gpu/ for the targets.
