# %% [markdown]
# # A column consolidates
# A column of saturated elastic soil is loaded on its drained surface. The pore pressure at its base is compared with
# Terzaghi's series. A few seconds on one core.

# %%
import matplotlib.pyplot as plt
import numpy as np

import mudline

HEIGHT, MODULUS, CONDUCTIVITY = 2.0, 4e6, 1e-9  # [m], constrained [Pa], hydraulic [m/s]

# %% [markdown]
# The deck is one of `mudline new`. `share` says how much of the pressure is dissipated when the run ends.

# %%
deck = mudline.Deck.based_on("column", height=HEIGHT, modulus=MODULUS, conductivity=CONDUCTIVITY, load="20 kPa")
deck["variables/share"] = "95 %"
result = mudline.run(deck, name="terzaghi")

# %% [markdown]
# The pressure at the base is a series of cosines in space, each of which decays for itself in the dimensionless time
# T = c_v t / H^2 (K. Terzaghi, Theoretical Soil Mechanics, 1943).

# %%
time, base = result.history.time, result.history["probe/base/pore pressure"]
factor = CONDUCTIVITY * MODULUS / 9810 * time / HEIGHT**2
m = np.pi / 2 * (2 * np.arange(200) + 1)
series = 20e3 * (2 * (-1.0) ** np.arange(200) / m * np.exp(-np.outer(factor, m**2))).sum(axis=1)

# %%
shown_time, time_unit = result.history.readable("time")
shown_base, base_unit = result.history.readable("probe/base/pore pressure")
figure, axes = plt.subplots()
axes.plot(shown_time, shown_base, label="mudline")
axes.plot(shown_time, series * shown_base[-1] / base[-1], "--", label="Terzaghi")
axes.set_xlabel(f"time [{time_unit}]")
axes.set_ylabel(f"pore pressure at the base [{base_unit}]")
axes.legend()

# %% [markdown]
# Once a twentieth of the time is over, both agree within 1 % of the load.

# %%
late = factor > 0.05
print(f"largest difference {100 * np.abs(base - series)[late].max() / 20e3:.2g} % of the load")
assert np.abs(base - series)[late].max() < 0.01 * 20e3
