# %% [markdown]
# # A cone penetration test of one's own
# A cone is pushed at constant rate into a block of saturated clay, ten metres below the seabed. The net cone
# resistance over the undrained strength is the cone factor N_kt.

# %%
import matplotlib.pyplot as plt
import numpy as np

import mudline

WAY = "6*diameter"  # of the cone
SU_TOP, SU_GROWTH, DEPTH = 3e3, 1.5e3, 10.0  # undrained strength at the seabed [Pa], its growth [Pa/m]; depth [m]

# %% [markdown]
# The numbers that are not given keep the defaults that `mudline new cpt --help` tells. The cone is hardly held in the
# end.

# %%
deck = mudline.Deck.based_on("cpt", su_top=SU_TOP, su_growth=SU_GROWTH, depth=DEPTH)
deck["variables/push"] = mudline.Expression(WAY)
deck["variables/rest"] = "1 s"
result = mudline.run(deck, name="own_cpt")

# %%
depth = -result.history["body/cone/displacement y"]
resistance, unit = result.history.readable("cone/sounding/net cone resistance")
figure, axes = plt.subplots()
axes.plot(resistance, 1e3 * depth)
axes.invert_yaxis()
axes.set_xlabel(f"net cone resistance [{unit}]")
axes.set_ylabel("way of the cone [mm]")

# %% [markdown]
# The cone factor that the program tells is that resistance over the strength at the cone's depth. Within the first
# diameters it grows still.

# %%
factor = result.results.value("sounding", "cone factor", "push")
net = result.results.value("sounding", "net cone resistance", "push")
strength = SU_TOP + SU_GROWTH * (DEPTH + result.results.value("cone", "depth of the tip", "push"))
print(f"after {WAY}: net resistance {net / 1e3:.4g} kPa, N_kt {factor:.3g}")
assert np.isclose(factor, net / strength, rtol=0.02)
