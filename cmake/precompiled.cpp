// The source that each set of precompiled headers needs (MudlinePackage.cmake).
