# %% [markdown]
# # The set-up of a pile
# A pile is jacked into saturated clay, rests, and is loaded. While it rests, the pore pressures dissipate and the
# clay gains strength: the resistance after a year over that after a day is the set-up.

# %%
import matplotlib.pyplot as plt

import mudline

DEPTH, SIDE = "2 m", "diameter/20"  # of the pile's foot; length of the elements' sides along the pile
RESTS = ("1 day", "1 year")

# %% [markdown]
# One run does both: the deck has a branch, which goes on from the end of `push` with the longer rest.

# %%
deck = mudline.Deck.based_on("pile", depth=DEPTH, rest=RESTS[0], longer_rest=RESTS[1])
deck["mesh/size near body"] = mudline.Expression("0.3*" + SIDE)
deck["mesh motion/boundary/size near focus"] = mudline.Expression(SIDE)
after_a_day = mudline.run(deck, name="pile_set_up")
after_a_year = mudline.Result("results/pile_set_up_longer_rest")

# %%
figure, axes = plt.subplots()
for rest, result in zip(RESTS, (after_a_day, after_a_year)):
    excess = result.results.value("pile", "excess pore pressure on the wall at the end", "set-up")
    resistance = result.results.value("pile", "highest resistance", "load test")
    print(f"after {rest}: excess pore pressure {excess / 1e3:.3g} kPa, resistance {resistance / 1e3:.4g} kN")
    force, unit = result.history.readable("contact/pile/reaction y")
    axes.plot(result.history["body/pile/displacement y"], force, label=f"{rest} of rest")
axes.set_xlabel("displacement of the pile [m]")
axes.set_ylabel(f"force on the pile [{unit}]")
axes.legend()

# %% [markdown]
# The excess pressure on the wall falls with the rest; the resistances say what the pile gains by it.

# %%
both = after_a_day, after_a_year
first, last = (result.results.value("pile", "highest resistance", "load test") for result in both)
left = [result.results.value("pile", "excess pore pressure on the wall at the end", "set-up") for result in both]
print(f"set-up {last / first:.3g}")
assert left[1] < left[0]
