; From route_search.cpp, SHA-256 8a3f0e1f6afa05e0bf6d6d916b32f92968515a9ccbc9ac0fc0c5cfe4bbd024c0, by tools/native.py. Do not edit.

%struct.Point = type { <16 x float>, <16 x float>, <16 x float> }
%struct.Motion = type { [17 x float], [17 x float], [136 x float], [136 x float] }
%struct.Frame = type { [9 x <16 x float>], [3 x <16 x float>] }
%struct.Joint = type { [9 x float], [3 x float], float }
%struct.Sphere = type { float, float, float, float }
%struct.Object = type { [9 x float], [3 x float], [3 x float], float, float, float }
%struct.LinkPair = type { i64, i64, i64, i64 }
%struct.Part = type { [3 x float], [3 x float], float, float }
%struct.PartPair = type { i64, i64 }
%struct.Point.4 = type { <8 x double>, <8 x double>, <8 x double> }
%struct.Motion.1 = type { [17 x double], [17 x double], [136 x double], [136 x double] }
%struct.Piece = type { double, double }
%struct.Frame.2 = type { [9 x <8 x double>], [3 x <8 x double>] }
%struct.Joint.3 = type { [9 x double], [3 x double], double }
%struct.Sphere.5 = type { double, double, double, double }
%struct.Object.6 = type { [9 x double], [3 x double], [3 x double], double, double, double }
%struct.Part.7 = type { [3 x double], [3 x double], double, double }
%struct.Tree = type { ptr, ptr, i64 }
%struct.Random = type { i64 }

define void @check_edges(ptr nocapture noundef readonly %0, ptr nocapture noundef readonly %1, ptr nocapture noundef readonly %2, i64 noundef %3, float noundef %4, float noundef %5, ptr nocapture noundef writeonly %6) {
  %8 = icmp sgt i64 %3, 0
  br i1 %8, label %10, label %9

9:
  ret void

10:
  %11 = phi i64 [ %19, %10 ], [ 0, %7 ]
  %12 = load i64, ptr %0, align 8
  %13 = mul nsw i64 %12, %11
  %14 = getelementptr inbounds float, ptr %1, i64 %13
  %15 = getelementptr inbounds float, ptr %2, i64 %13
  %16 = tail call fastcc noundef zeroext i1 @_ZL12is_edge_freeRK5SceneIfEPKfS4_ff(ptr noundef nonnull align 8 dereferenceable(136) %0, ptr noundef %14, ptr noundef %15, float noundef %4, float noundef %5)
  %17 = zext i1 %16 to i8
  %18 = getelementptr inbounds i8, ptr %6, i64 %11
  store i8 %17, ptr %18, align 1
  %19 = add nuw nsw i64 %11, 1
  %20 = icmp eq i64 %19, %3
  br i1 %20, label %9, label %10
}

declare void @llvm.lifetime.start.p0(i64 immarg, ptr nocapture)

define internal fastcc noundef zeroext i1 @_ZL12is_edge_freeRK5SceneIfEPKfS4_ff(ptr nocapture noundef nonnull readonly align 8 dereferenceable(136) %0, ptr nocapture noundef readonly %1, ptr nocapture noundef readonly %2, float noundef %3, float noundef %4) unnamed_addr {
  %6 = alloca [192 x %struct.Point], align 64
  %7 = alloca [2 x i64], align 16
  %8 = alloca [9 x <16 x float>], align 64
  %9 = alloca %struct.Motion, align 4
  %10 = alloca [17 x %struct.Frame], align 64
  call void @llvm.lifetime.start.p0(i64 1224, ptr nonnull %9)
  %11 = getelementptr inbounds i8, ptr %9, i64 136
  %12 = load i64, ptr %0, align 8
  %13 = icmp slt i64 %12, 0
  br i1 %13, label %18, label %14

14:
  %15 = getelementptr inbounds i8, ptr %0, i64 112
  %16 = icmp eq i64 %12, 0
  %17 = load ptr, ptr %15, align 8
  br label %26

18:
  %19 = getelementptr inbounds i8, ptr %0, i64 16
  %20 = load i64, ptr %19, align 8
  %21 = icmp sgt i64 %20, 0
  br i1 %21, label %22, label %72

22:
  %23 = getelementptr inbounds i8, ptr %0, i64 120
  %24 = icmp sgt i64 %12, 0
  %25 = load ptr, ptr %23, align 8
  br label %49

26:
  %27 = phi i64 [ 0, %14 ], [ %47, %44 ]
  %28 = mul nuw nsw i64 %27, %12
  %29 = getelementptr inbounds float, ptr %17, i64 %28
  br i1 %16, label %44, label %30

30:
  %31 = phi i64 [ %42, %30 ], [ 0, %26 ]
  %32 = phi float [ %41, %30 ], [ 0.000000e+00, %26 ]
  %33 = getelementptr inbounds float, ptr %29, i64 %31
  %34 = load float, ptr %33, align 4
  %35 = getelementptr inbounds float, ptr %2, i64 %31
  %36 = load float, ptr %35, align 4
  %37 = fcmp contract olt float %36, 0.000000e+00
  %38 = fneg contract float %36
  %39 = select contract i1 %37, float %38, float %36
  %40 = fmul contract float %34, %39
  %41 = fadd contract float %32, %40
  %42 = add nuw nsw i64 %31, 1
  %43 = icmp eq i64 %42, %12
  br i1 %43, label %44, label %30

44:
  %45 = phi float [ 0.000000e+00, %26 ], [ %41, %30 ]
  %46 = getelementptr inbounds float, ptr %9, i64 %27
  store float %45, ptr %46, align 4
  %47 = add nuw i64 %27, 1
  %48 = icmp eq i64 %27, %12
  br i1 %48, label %18, label %26

49:
  %50 = phi i64 [ 0, %22 ], [ %70, %67 ]
  %51 = mul nsw i64 %50, %12
  %52 = getelementptr inbounds float, ptr %25, i64 %51
  br i1 %24, label %53, label %67

53:
  %54 = phi i64 [ %65, %53 ], [ 0, %49 ]
  %55 = phi float [ %64, %53 ], [ 0.000000e+00, %49 ]
  %56 = getelementptr inbounds float, ptr %52, i64 %54
  %57 = load float, ptr %56, align 4
  %58 = getelementptr inbounds float, ptr %2, i64 %54
  %59 = load float, ptr %58, align 4
  %60 = fcmp contract olt float %59, 0.000000e+00
  %61 = fneg contract float %59
  %62 = select contract i1 %60, float %61, float %59
  %63 = fmul contract float %57, %62
  %64 = fadd contract float %55, %63
  %65 = add nuw nsw i64 %54, 1
  %66 = icmp eq i64 %65, %12
  br i1 %66, label %67, label %53

67:
  %68 = phi float [ 0.000000e+00, %49 ], [ %64, %53 ]
  %69 = getelementptr inbounds float, ptr %11, i64 %50
  store float %68, ptr %69, align 4
  %70 = add nuw nsw i64 %50, 1
  %71 = icmp eq i64 %70, %20
  br i1 %71, label %72, label %49

72:
  br label %73

73:
  %74 = phi i64 [ %76, %73 ], [ 68, %72 ]
  %75 = getelementptr inbounds i8, ptr %9, i64 %74
  store float %4, ptr %75, align 4
  %76 = add nuw nsw i64 %74, 4
  %77 = icmp eq i64 %76, 136
  br i1 %77, label %107, label %73

78:
  br i1 %13, label %79, label %81

79:
  %80 = phi float [ 0.000000e+00, %78 ], [ %87, %81 ]
  br i1 %21, label %90, label %99

81:
  %82 = phi i64 [ %88, %81 ], [ 0, %78 ]
  %83 = phi float [ %87, %81 ], [ 0.000000e+00, %78 ]
  %84 = getelementptr inbounds [17 x float], ptr %9, i64 0, i64 %82
  %85 = load float, ptr %84, align 4
  %86 = fcmp contract ogt float %85, %83
  %87 = select i1 %86, float %85, float %83
  %88 = add nuw i64 %82, 1
  %89 = icmp eq i64 %82, %12
  br i1 %89, label %79, label %81

90:
  %91 = phi i64 [ %97, %90 ], [ 0, %79 ]
  %92 = phi float [ %96, %90 ], [ %80, %79 ]
  %93 = getelementptr inbounds [136 x float], ptr %11, i64 0, i64 %91
  %94 = load float, ptr %93, align 4
  %95 = fcmp contract ogt float %94, %92
  %96 = select i1 %95, float %94, float %92
  %97 = add nuw nsw i64 %91, 1
  %98 = icmp eq i64 %97, %20
  br i1 %98, label %99, label %90

99:
  %100 = phi float [ %80, %79 ], [ %96, %90 ]
  %101 = fmul contract float %3, 1.600000e+01
  %102 = fdiv contract float %100, %101
  %103 = fptosi float %102 to i64
  %104 = add i64 %103, 1
  %105 = shl nsw i64 %104, 4
  %106 = sitofp i64 %105 to float
  br label %153

107:
  %108 = phi i64 [ %110, %107 ], [ 680, %73 ]
  %109 = getelementptr inbounds i8, ptr %9, i64 %108
  store float %4, ptr %109, align 4
  %110 = add nuw nsw i64 %108, 4
  %111 = icmp eq i64 %110, 1224
  br i1 %111, label %78, label %107

112:
  call void @llvm.lifetime.start.p0(i64 13056, ptr nonnull %10)
  %113 = icmp slt i64 %103, 0
  br i1 %113, label %1234, label %114

114:
  %115 = fdiv contract float 1.000000e+00, %106
  %116 = insertelement <16 x float> poison, float %115, i64 0
  %117 = shufflevector <16 x float> %116, <16 x float> poison, <16 x i32> zeroinitializer
  %118 = getelementptr inbounds i8, ptr %10, i64 576
  %119 = icmp sgt i64 %12, 0
  %120 = getelementptr inbounds i8, ptr %0, i64 24
  %121 = load ptr, ptr %120, align 8
  %122 = fmul contract <16 x float> %159, zeroinitializer
  %123 = fmul contract <16 x float> %122, zeroinitializer
  %124 = icmp slt i64 %12, 1
  %125 = getelementptr inbounds i8, ptr %0, i64 48
  %126 = load ptr, ptr %125, align 8
  %127 = getelementptr inbounds i8, ptr %9, i64 68
  %128 = getelementptr inbounds i8, ptr %0, i64 8
  %129 = load i64, ptr %128, align 8
  %130 = icmp sgt i64 %129, 0
  %131 = getelementptr inbounds i8, ptr %0, i64 56
  %132 = load ptr, ptr %131, align 8
  %133 = getelementptr inbounds i8, ptr %0, i64 64
  %134 = load ptr, ptr %133, align 8
  %135 = getelementptr inbounds i8, ptr %0, i64 32
  %136 = load ptr, ptr %135, align 8
  %137 = getelementptr inbounds i8, ptr %0, i64 40
  %138 = load ptr, ptr %137, align 8
  %139 = getelementptr inbounds i8, ptr %0, i64 96
  %140 = load ptr, ptr %139, align 8
  %141 = getelementptr inbounds i8, ptr %0, i64 88
  %142 = load ptr, ptr %141, align 8
  %143 = getelementptr inbounds i8, ptr %9, i64 680
  %144 = getelementptr inbounds i8, ptr %0, i64 128
  %145 = load ptr, ptr %144, align 8
  %146 = getelementptr inbounds i8, ptr %7, i64 8
  %147 = getelementptr inbounds i8, ptr %0, i64 80
  %148 = load ptr, ptr %147, align 8
  %149 = getelementptr inbounds i8, ptr %0, i64 72
  %150 = load ptr, ptr %149, align 8
  %151 = getelementptr inbounds i8, ptr %0, i64 104
  %152 = load ptr, ptr %151, align 8
  br label %166

153:
  %154 = phi i64 [ 0, %99 ], [ %160, %153 ]
  %155 = phi <16 x float> [ undef, %99 ], [ %159, %153 ]
  %156 = mul nsw i64 %154, %104
  %157 = add nsw i64 %156, 1
  %158 = sitofp i64 %157 to float
  %159 = insertelement <16 x float> %155, float %158, i64 %154
  %160 = add nuw nsw i64 %154, 1
  %161 = icmp eq i64 %160, 16
  br i1 %161, label %112, label %153

162:
  %163 = add nuw i64 %168, 1
  %164 = icmp sge i64 %168, %103
  %165 = icmp eq i64 %168, %103
  br i1 %165, label %1234, label %166

166:
  %167 = phi i1 [ false, %114 ], [ %164, %162 ]
  %168 = phi i64 [ 0, %114 ], [ %163, %162 ]
  %169 = uitofp nneg i64 %168 to float
  %170 = insertelement <16 x float> poison, float %169, i64 0
  %171 = shufflevector <16 x float> %170, <16 x float> poison, <16 x i32> zeroinitializer
  %172 = fadd contract <16 x float> %159, %171
  %173 = fmul contract <16 x float> %117, %172
  %174 = fmul contract <16 x float> %173, zeroinitializer
  br label %175

175:
  %176 = phi i64 [ 0, %166 ], [ %184, %175 ]
  %177 = and i64 %176, 3
  %178 = icmp eq i64 %177, 0
  %179 = uitofp i1 %178 to float
  %180 = insertelement <16 x float> poison, float %179, i64 0
  %181 = shufflevector <16 x float> %180, <16 x float> poison, <16 x i32> zeroinitializer
  %182 = fadd contract <16 x float> %174, %181
  %183 = getelementptr inbounds [9 x <16 x float>], ptr %10, i64 0, i64 %176
  store <16 x float> %182, ptr %183, align 64
  %184 = add nuw nsw i64 %176, 1
  %185 = icmp eq i64 %184, 9
  br i1 %185, label %187, label %175

186:
  br i1 %119, label %192, label %721

187:
  %188 = phi i64 [ %190, %187 ], [ 0, %175 ]
  %189 = getelementptr inbounds [3 x <16 x float>], ptr %118, i64 0, i64 %188
  store <16 x float> %174, ptr %189, align 64
  %190 = add nuw nsw i64 %188, 1
  %191 = icmp eq i64 %190, 3
  br i1 %191, label %186, label %187

192:
  %193 = phi i64 [ %196, %388 ], [ 0, %186 ]
  %194 = getelementptr inbounds %struct.Joint, ptr %121, i64 %193
  %195 = getelementptr inbounds %struct.Frame, ptr %10, i64 %193
  %196 = add nuw nsw i64 %193, 1
  %197 = getelementptr inbounds float, ptr %1, i64 %193
  %198 = load float, ptr %197, align 4
  %199 = insertelement <16 x float> poison, float %198, i64 0
  %200 = getelementptr inbounds float, ptr %2, i64 %193
  %201 = load float, ptr %200, align 4
  %202 = insertelement <16 x float> poison, float %201, i64 0
  %203 = shufflevector <16 x float> %202, <16 x float> poison, <16 x i32> zeroinitializer
  %204 = fmul contract <16 x float> %173, %203
  %205 = getelementptr inbounds i8, ptr %194, i64 36
  %206 = load float, ptr %205, align 4
  %207 = getelementptr inbounds i8, ptr %194, i64 40
  %208 = load float, ptr %207, align 4
  %209 = getelementptr inbounds i8, ptr %194, i64 44
  %210 = load float, ptr %209, align 4
  %211 = getelementptr inbounds i8, ptr %195, i64 576
  %212 = load <16 x float>, ptr %211, align 64
  %213 = load <16 x float>, ptr %195, align 64
  %214 = insertelement <16 x float> poison, float %206, i64 0
  %215 = shufflevector <16 x float> %214, <16 x float> poison, <16 x i32> zeroinitializer
  %216 = fmul contract <16 x float> %215, %213
  %217 = getelementptr inbounds i8, ptr %195, i64 64
  %218 = load <16 x float>, ptr %217, align 64
  %219 = insertelement <16 x float> poison, float %208, i64 0
  %220 = shufflevector <16 x float> %219, <16 x float> poison, <16 x i32> zeroinitializer
  %221 = fmul contract <16 x float> %220, %218
  %222 = getelementptr inbounds i8, ptr %195, i64 128
  %223 = load <16 x float>, ptr %222, align 64
  %224 = insertelement <16 x float> poison, float %210, i64 0
  %225 = shufflevector <16 x float> %224, <16 x float> poison, <16 x i32> zeroinitializer
  %226 = fmul contract <16 x float> %225, %223
  %227 = getelementptr inbounds i8, ptr %195, i64 640
  %228 = load <16 x float>, ptr %227, align 64
  %229 = getelementptr inbounds i8, ptr %195, i64 192
  %230 = load <16 x float>, ptr %229, align 64
  %231 = fmul contract <16 x float> %215, %230
  %232 = getelementptr inbounds i8, ptr %195, i64 256
  %233 = load <16 x float>, ptr %232, align 64
  %234 = fmul contract <16 x float> %220, %233
  %235 = getelementptr inbounds i8, ptr %195, i64 320
  %236 = load <16 x float>, ptr %235, align 64
  %237 = fmul contract <16 x float> %225, %236
  %238 = getelementptr inbounds i8, ptr %195, i64 704
  %239 = load <16 x float>, ptr %238, align 64
  %240 = getelementptr inbounds i8, ptr %195, i64 384
  %241 = load <16 x float>, ptr %240, align 64
  %242 = fmul contract <16 x float> %215, %241
  %243 = getelementptr inbounds i8, ptr %195, i64 448
  %244 = load <16 x float>, ptr %243, align 64
  %245 = fmul contract <16 x float> %220, %244
  %246 = getelementptr inbounds i8, ptr %195, i64 512
  %247 = load <16 x float>, ptr %246, align 64
  %248 = fmul contract <16 x float> %225, %247
  call void @llvm.lifetime.start.p0(i64 576, ptr nonnull %8)
  br label %249

249:
  %250 = phi i64 [ 0, %192 ], [ %280, %279 ]
  %251 = mul nuw nsw i64 %250, 3
  %252 = getelementptr inbounds [9 x <16 x float>], ptr %195, i64 0, i64 %251
  %253 = load <16 x float>, ptr %252, align 64
  %254 = add nuw nsw i64 %251, 1
  %255 = getelementptr inbounds [9 x <16 x float>], ptr %195, i64 0, i64 %254
  %256 = load <16 x float>, ptr %255, align 64
  %257 = add nuw nsw i64 %251, 2
  %258 = getelementptr inbounds [9 x <16 x float>], ptr %195, i64 0, i64 %257
  %259 = load <16 x float>, ptr %258, align 64
  br label %282

260:
  %261 = getelementptr inbounds %struct.Frame, ptr %10, i64 %196
  %262 = shufflevector <16 x float> %199, <16 x float> poison, <16 x i32> zeroinitializer
  %263 = fadd contract <16 x float> %262, %204
  %264 = fadd contract <16 x float> %212, %216
  %265 = fadd contract <16 x float> %264, %221
  %266 = fadd contract <16 x float> %265, %226
  %267 = fadd contract <16 x float> %228, %231
  %268 = fadd contract <16 x float> %267, %234
  %269 = fadd contract <16 x float> %268, %237
  %270 = fadd contract <16 x float> %239, %242
  %271 = fadd contract <16 x float> %270, %245
  %272 = fadd contract <16 x float> %271, %248
  %273 = getelementptr inbounds i8, ptr %261, i64 576
  store <16 x float> %266, ptr %273, align 64
  %274 = getelementptr inbounds i8, ptr %261, i64 640
  store <16 x float> %269, ptr %274, align 64
  %275 = getelementptr inbounds i8, ptr %261, i64 704
  store <16 x float> %272, ptr %275, align 64
  %276 = getelementptr inbounds i8, ptr %194, i64 48
  %277 = load float, ptr %276, align 4
  %278 = fcmp contract une float %277, 0.000000e+00
  br i1 %278, label %307, label %326

279:
  %280 = add nuw nsw i64 %250, 1
  %281 = icmp eq i64 %280, 3
  br i1 %281, label %260, label %249

282:
  %283 = phi i64 [ 0, %249 ], [ %305, %282 ]
  %284 = getelementptr inbounds [9 x float], ptr %194, i64 0, i64 %283
  %285 = load float, ptr %284, align 4
  %286 = insertelement <16 x float> poison, float %285, i64 0
  %287 = shufflevector <16 x float> %286, <16 x float> poison, <16 x i32> zeroinitializer
  %288 = fmul contract <16 x float> %253, %287
  %289 = add nuw nsw i64 %283, 3
  %290 = getelementptr inbounds [9 x float], ptr %194, i64 0, i64 %289
  %291 = load float, ptr %290, align 4
  %292 = insertelement <16 x float> poison, float %291, i64 0
  %293 = shufflevector <16 x float> %292, <16 x float> poison, <16 x i32> zeroinitializer
  %294 = fmul contract <16 x float> %256, %293
  %295 = fadd contract <16 x float> %288, %294
  %296 = add nuw nsw i64 %283, 6
  %297 = getelementptr inbounds [9 x float], ptr %194, i64 0, i64 %296
  %298 = load float, ptr %297, align 4
  %299 = insertelement <16 x float> poison, float %298, i64 0
  %300 = shufflevector <16 x float> %299, <16 x float> poison, <16 x i32> zeroinitializer
  %301 = fmul contract <16 x float> %259, %300
  %302 = fadd contract <16 x float> %295, %301
  %303 = add nuw nsw i64 %283, %251
  %304 = getelementptr inbounds [9 x <16 x float>], ptr %8, i64 0, i64 %303
  store <16 x float> %302, ptr %304, align 64
  %305 = add nuw nsw i64 %283, 1
  %306 = icmp eq i64 %305, 3
  br i1 %306, label %279, label %282

307:
  %308 = phi i64 [ %312, %307 ], [ 0, %260 ]
  %309 = getelementptr inbounds [9 x <16 x float>], ptr %8, i64 0, i64 %308
  %310 = load <16 x float>, ptr %309, align 64
  %311 = getelementptr inbounds [9 x <16 x float>], ptr %261, i64 0, i64 %308
  store <16 x float> %310, ptr %311, align 64
  %312 = add nuw nsw i64 %308, 1
  %313 = icmp eq i64 %312, 9
  br i1 %313, label %314, label %307

314:
  %315 = phi i64 [ %324, %314 ], [ 0, %307 ]
  %316 = mul nuw nsw i64 %315, 3
  %317 = add nuw nsw i64 %316, 2
  %318 = getelementptr inbounds [9 x <16 x float>], ptr %8, i64 0, i64 %317
  %319 = load <16 x float>, ptr %318, align 64
  %320 = fmul contract <16 x float> %263, %319
  %321 = getelementptr inbounds [3 x <16 x float>], ptr %273, i64 0, i64 %315
  %322 = load <16 x float>, ptr %321, align 64
  %323 = fadd contract <16 x float> %322, %320
  store <16 x float> %323, ptr %321, align 64
  %324 = add nuw nsw i64 %315, 1
  %325 = icmp eq i64 %324, 3
  br i1 %325, label %388, label %314

326:
  %327 = fmul contract <16 x float> %263, <float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000>
  %328 = fadd contract <16 x float> %327, <float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000>
  %329 = fadd contract <16 x float> %328, <float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000>
  %330 = fmul contract <16 x float> %329, <float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000>
  %331 = fsub contract <16 x float> %263, %330
  %332 = fmul contract <16 x float> %329, <float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000>
  %333 = fsub contract <16 x float> %331, %332
  %334 = fmul contract <16 x float> %329, <float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000>
  %335 = fsub contract <16 x float> %333, %334
  %336 = fmul contract <16 x float> %329, <float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01>
  %337 = fadd contract <16 x float> %336, <float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000>
  %338 = fadd contract <16 x float> %337, <float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000>
  %339 = fsub contract <16 x float> %336, %338
  %340 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %339)
  %341 = fmul contract <16 x float> %340, <float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00>
  %342 = fsub contract <16 x float> <float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00>, %341
  %343 = fmul contract <16 x float> %335, %335
  %344 = fmul contract <16 x float> %335, %343
  %345 = fmul contract <16 x float> %343, <float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000>
  %346 = fadd contract <16 x float> %345, <float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000>
  %347 = fmul contract <16 x float> %343, %346
  %348 = fadd contract <16 x float> %347, <float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000>
  %349 = fmul contract <16 x float> %343, %348
  %350 = fadd contract <16 x float> %349, <float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000>
  %351 = fmul contract <16 x float> %344, %350
  %352 = fadd contract <16 x float> %335, %351
  %353 = fmul contract <16 x float> %342, %352
  %354 = fmul contract <16 x float> %343, <float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01>
  %355 = fsub contract <16 x float> <float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00>, %354
  %356 = fmul contract <16 x float> %343, %343
  %357 = fmul contract <16 x float> %343, <float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000>
  %358 = fsub contract <16 x float> <float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000>, %357
  %359 = fmul contract <16 x float> %343, %358
  %360 = fadd contract <16 x float> %359, <float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000>
  %361 = fmul contract <16 x float> %343, %360
  %362 = fadd contract <16 x float> %361, <float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000>
  %363 = fmul contract <16 x float> %356, %362
  %364 = fadd contract <16 x float> %355, %363
  %365 = fmul contract <16 x float> %342, %364
  br label %366

366:
  %367 = phi i64 [ 0, %326 ], [ %386, %366 ]
  %368 = mul nuw nsw i64 %367, 3
  %369 = getelementptr inbounds [9 x <16 x float>], ptr %8, i64 0, i64 %368
  %370 = load <16 x float>, ptr %369, align 64
  %371 = fmul contract <16 x float> %365, %370
  %372 = add nuw nsw i64 %368, 1
  %373 = getelementptr inbounds [9 x <16 x float>], ptr %8, i64 0, i64 %372
  %374 = load <16 x float>, ptr %373, align 64
  %375 = fmul contract <16 x float> %353, %374
  %376 = fadd contract <16 x float> %371, %375
  %377 = getelementptr inbounds [9 x <16 x float>], ptr %261, i64 0, i64 %368
  store <16 x float> %376, ptr %377, align 64
  %378 = fmul contract <16 x float> %365, %374
  %379 = fmul contract <16 x float> %353, %370
  %380 = fsub contract <16 x float> %378, %379
  %381 = getelementptr inbounds [9 x <16 x float>], ptr %261, i64 0, i64 %372
  store <16 x float> %380, ptr %381, align 64
  %382 = add nuw nsw i64 %368, 2
  %383 = getelementptr inbounds [9 x <16 x float>], ptr %8, i64 0, i64 %382
  %384 = load <16 x float>, ptr %383, align 64
  %385 = getelementptr inbounds [9 x <16 x float>], ptr %261, i64 0, i64 %382
  store <16 x float> %384, ptr %385, align 64
  %386 = add nuw nsw i64 %367, 1
  %387 = icmp eq i64 %386, 3
  br i1 %387, label %388, label %366

388:
  call void @llvm.lifetime.end.p0(i64 576, ptr nonnull %8)
  %389 = icmp eq i64 %196, %12
  br i1 %389, label %390, label %192

390:
  br i1 %124, label %721, label %391

391:
  %392 = phi <16 x i32> [ %718, %717 ], [ zeroinitializer, %390 ]
  %393 = phi i64 [ %719, %717 ], [ 1, %390 ]
  %394 = getelementptr inbounds %struct.Sphere, ptr %126, i64 %393
  %395 = getelementptr inbounds i8, ptr %394, i64 12
  %396 = load float, ptr %395, align 4
  %397 = fcmp contract olt float %396, 0.000000e+00
  br i1 %397, label %717, label %398

398:
  %399 = getelementptr inbounds %struct.Frame, ptr %10, i64 %393
  %400 = load float, ptr %394, align 4
  %401 = getelementptr inbounds i8, ptr %394, i64 4
  %402 = load float, ptr %401, align 4
  %403 = getelementptr inbounds i8, ptr %394, i64 8
  %404 = load float, ptr %403, align 4
  %405 = getelementptr inbounds i8, ptr %399, i64 576
  %406 = load <16 x float>, ptr %405, align 64
  %407 = load <16 x float>, ptr %399, align 64
  %408 = insertelement <16 x float> poison, float %400, i64 0
  %409 = shufflevector <16 x float> %408, <16 x float> poison, <16 x i32> zeroinitializer
  %410 = fmul contract <16 x float> %409, %407
  %411 = fadd contract <16 x float> %406, %410
  %412 = getelementptr inbounds i8, ptr %399, i64 64
  %413 = load <16 x float>, ptr %412, align 64
  %414 = insertelement <16 x float> poison, float %402, i64 0
  %415 = shufflevector <16 x float> %414, <16 x float> poison, <16 x i32> zeroinitializer
  %416 = fmul contract <16 x float> %415, %413
  %417 = fadd contract <16 x float> %411, %416
  %418 = getelementptr inbounds i8, ptr %399, i64 128
  %419 = load <16 x float>, ptr %418, align 64
  %420 = insertelement <16 x float> poison, float %404, i64 0
  %421 = shufflevector <16 x float> %420, <16 x float> poison, <16 x i32> zeroinitializer
  %422 = fmul contract <16 x float> %421, %419
  %423 = fadd contract <16 x float> %417, %422
  %424 = getelementptr inbounds i8, ptr %399, i64 640
  %425 = load <16 x float>, ptr %424, align 64
  %426 = getelementptr inbounds i8, ptr %399, i64 192
  %427 = load <16 x float>, ptr %426, align 64
  %428 = fmul contract <16 x float> %409, %427
  %429 = fadd contract <16 x float> %425, %428
  %430 = getelementptr inbounds i8, ptr %399, i64 256
  %431 = load <16 x float>, ptr %430, align 64
  %432 = fmul contract <16 x float> %415, %431
  %433 = fadd contract <16 x float> %429, %432
  %434 = getelementptr inbounds i8, ptr %399, i64 320
  %435 = load <16 x float>, ptr %434, align 64
  %436 = fmul contract <16 x float> %421, %435
  %437 = fadd contract <16 x float> %433, %436
  %438 = getelementptr inbounds i8, ptr %399, i64 704
  %439 = load <16 x float>, ptr %438, align 64
  %440 = getelementptr inbounds i8, ptr %399, i64 384
  %441 = load <16 x float>, ptr %440, align 64
  %442 = fmul contract <16 x float> %409, %441
  %443 = fadd contract <16 x float> %439, %442
  %444 = getelementptr inbounds i8, ptr %399, i64 448
  %445 = load <16 x float>, ptr %444, align 64
  %446 = fmul contract <16 x float> %415, %445
  %447 = fadd contract <16 x float> %443, %446
  %448 = getelementptr inbounds i8, ptr %399, i64 512
  %449 = load <16 x float>, ptr %448, align 64
  %450 = fmul contract <16 x float> %421, %449
  %451 = fadd contract <16 x float> %447, %450
  %452 = getelementptr inbounds [17 x float], ptr %9, i64 0, i64 %393
  %453 = load float, ptr %452, align 4
  %454 = insertelement <16 x float> poison, float %453, i64 0
  %455 = shufflevector <16 x float> %454, <16 x float> poison, <16 x i32> zeroinitializer
  %456 = fmul contract <16 x float> %122, %455
  %457 = getelementptr inbounds [17 x float], ptr %127, i64 0, i64 %393
  %458 = load float, ptr %457, align 4
  %459 = insertelement <16 x float> poison, float %458, i64 0
  %460 = shufflevector <16 x float> %459, <16 x float> poison, <16 x i32> zeroinitializer
  %461 = fadd contract <16 x float> %456, %460
  br i1 %130, label %462, label %717

462:
  %463 = mul nuw nsw i64 %129, %393
  %464 = getelementptr float, ptr %134, i64 %463
  %465 = getelementptr inbounds i64, ptr %136, i64 %393
  %466 = getelementptr inbounds i8, ptr %465, i64 8
  br label %467

467:
  %468 = phi <16 x i32> [ %392, %462 ], [ %714, %713 ]
  %469 = phi i64 [ 0, %462 ], [ %715, %713 ]
  %470 = getelementptr inbounds %struct.Object, ptr %132, i64 %469
  %471 = getelementptr float, ptr %464, i64 %469
  %472 = load float, ptr %471, align 4
  %473 = getelementptr inbounds i8, ptr %470, i64 60
  %474 = load float, ptr %473, align 4
  %475 = fadd contract float %472, %474
  %476 = fcmp contract olt float %475, -1.000000e+08
  br i1 %476, label %713, label %477

477:
  %478 = fadd contract float %396, %475
  %479 = insertelement <16 x float> poison, float %478, i64 0
  %480 = shufflevector <16 x float> %479, <16 x float> poison, <16 x i32> zeroinitializer
  %481 = fadd contract <16 x float> %461, %480
  %482 = fcmp contract ogt <16 x float> %481, %123
  %483 = select contract <16 x i1> %482, <16 x float> %481, <16 x float> %123
  %484 = getelementptr inbounds i8, ptr %470, i64 36
  %485 = load float, ptr %484, align 4
  %486 = insertelement <16 x float> poison, float %485, i64 0
  %487 = shufflevector <16 x float> %486, <16 x float> poison, <16 x i32> zeroinitializer
  %488 = load float, ptr %470, align 4
  %489 = insertelement <16 x float> poison, float %488, i64 0
  %490 = shufflevector <16 x float> %489, <16 x float> poison, <16 x i32> zeroinitializer
  %491 = fmul contract <16 x float> %423, %490
  %492 = fadd contract <16 x float> %487, %491
  %493 = getelementptr inbounds i8, ptr %470, i64 4
  %494 = load float, ptr %493, align 4
  %495 = insertelement <16 x float> poison, float %494, i64 0
  %496 = shufflevector <16 x float> %495, <16 x float> poison, <16 x i32> zeroinitializer
  %497 = fmul contract <16 x float> %437, %496
  %498 = fadd contract <16 x float> %492, %497
  %499 = getelementptr inbounds i8, ptr %470, i64 8
  %500 = load float, ptr %499, align 4
  %501 = insertelement <16 x float> poison, float %500, i64 0
  %502 = shufflevector <16 x float> %501, <16 x float> poison, <16 x i32> zeroinitializer
  %503 = fmul contract <16 x float> %451, %502
  %504 = fadd contract <16 x float> %498, %503
  %505 = getelementptr inbounds i8, ptr %470, i64 40
  %506 = load float, ptr %505, align 4
  %507 = insertelement <16 x float> poison, float %506, i64 0
  %508 = shufflevector <16 x float> %507, <16 x float> poison, <16 x i32> zeroinitializer
  %509 = getelementptr inbounds i8, ptr %470, i64 12
  %510 = load float, ptr %509, align 4
  %511 = insertelement <16 x float> poison, float %510, i64 0
  %512 = shufflevector <16 x float> %511, <16 x float> poison, <16 x i32> zeroinitializer
  %513 = fmul contract <16 x float> %423, %512
  %514 = fadd contract <16 x float> %508, %513
  %515 = getelementptr inbounds i8, ptr %470, i64 16
  %516 = load float, ptr %515, align 4
  %517 = insertelement <16 x float> poison, float %516, i64 0
  %518 = shufflevector <16 x float> %517, <16 x float> poison, <16 x i32> zeroinitializer
  %519 = fmul contract <16 x float> %437, %518
  %520 = fadd contract <16 x float> %514, %519
  %521 = getelementptr inbounds i8, ptr %470, i64 20
  %522 = load float, ptr %521, align 4
  %523 = insertelement <16 x float> poison, float %522, i64 0
  %524 = shufflevector <16 x float> %523, <16 x float> poison, <16 x i32> zeroinitializer
  %525 = fmul contract <16 x float> %451, %524
  %526 = fadd contract <16 x float> %520, %525
  %527 = getelementptr inbounds i8, ptr %470, i64 44
  %528 = load float, ptr %527, align 4
  %529 = insertelement <16 x float> poison, float %528, i64 0
  %530 = shufflevector <16 x float> %529, <16 x float> poison, <16 x i32> zeroinitializer
  %531 = getelementptr inbounds i8, ptr %470, i64 24
  %532 = load float, ptr %531, align 4
  %533 = insertelement <16 x float> poison, float %532, i64 0
  %534 = shufflevector <16 x float> %533, <16 x float> poison, <16 x i32> zeroinitializer
  %535 = fmul contract <16 x float> %423, %534
  %536 = fadd contract <16 x float> %530, %535
  %537 = getelementptr inbounds i8, ptr %470, i64 28
  %538 = load float, ptr %537, align 4
  %539 = insertelement <16 x float> poison, float %538, i64 0
  %540 = shufflevector <16 x float> %539, <16 x float> poison, <16 x i32> zeroinitializer
  %541 = fmul contract <16 x float> %437, %540
  %542 = fadd contract <16 x float> %536, %541
  %543 = getelementptr inbounds i8, ptr %470, i64 32
  %544 = load float, ptr %543, align 4
  %545 = insertelement <16 x float> poison, float %544, i64 0
  %546 = shufflevector <16 x float> %545, <16 x float> poison, <16 x i32> zeroinitializer
  %547 = fmul contract <16 x float> %451, %546
  %548 = fadd contract <16 x float> %542, %547
  %549 = fmul contract <16 x float> %504, zeroinitializer
  %550 = getelementptr inbounds i8, ptr %470, i64 68
  %551 = load float, ptr %550, align 4
  %552 = fcmp contract une float %551, 0.000000e+00
  %553 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %548)
  %554 = select contract i1 %552, <16 x float> %548, <16 x float> %553
  %555 = getelementptr inbounds i8, ptr %470, i64 64
  %556 = load float, ptr %555, align 4
  %557 = fcmp contract une float %556, 0.000000e+00
  br i1 %557, label %558, label %563

558:
  %559 = fmul contract <16 x float> %504, %504
  %560 = fmul contract <16 x float> %526, %526
  %561 = fadd contract <16 x float> %559, %560
  %562 = tail call contract noundef <16 x float> @llvm.sqrt.v16f32(<16 x float> %561)
  br label %565

563:
  %564 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %504)
  br label %565

565:
  %566 = phi contract <16 x float> [ %562, %558 ], [ %564, %563 ]
  %567 = getelementptr inbounds i8, ptr %470, i64 48
  %568 = load float, ptr %567, align 4
  %569 = insertelement <16 x float> poison, float %568, i64 0
  %570 = shufflevector <16 x float> %569, <16 x float> poison, <16 x i32> zeroinitializer
  %571 = fsub contract <16 x float> %566, %570
  %572 = fcmp contract ogt <16 x float> %571, %549
  %573 = select contract <16 x i1> %572, <16 x float> %571, <16 x float> %549
  %574 = getelementptr inbounds i8, ptr %470, i64 56
  %575 = load float, ptr %574, align 4
  %576 = insertelement <16 x float> poison, float %575, i64 0
  %577 = shufflevector <16 x float> %576, <16 x float> poison, <16 x i32> zeroinitializer
  %578 = fsub contract <16 x float> %554, %577
  %579 = fcmp contract ogt <16 x float> %578, %549
  %580 = select contract <16 x i1> %579, <16 x float> %578, <16 x float> %549
  %581 = fmul contract <16 x float> %573, %573
  %582 = fmul contract <16 x float> %580, %580
  %583 = fadd contract <16 x float> %581, %582
  br i1 %557, label %595, label %584

584:
  %585 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %526)
  %586 = getelementptr inbounds i8, ptr %470, i64 52
  %587 = load float, ptr %586, align 4
  %588 = insertelement <16 x float> poison, float %587, i64 0
  %589 = shufflevector <16 x float> %588, <16 x float> poison, <16 x i32> zeroinitializer
  %590 = fsub contract <16 x float> %585, %589
  %591 = fcmp contract ogt <16 x float> %590, %549
  %592 = select contract <16 x i1> %591, <16 x float> %590, <16 x float> %549
  %593 = fmul contract <16 x float> %592, %592
  %594 = fadd contract <16 x float> %583, %593
  br label %595

595:
  %596 = phi <16 x float> [ %594, %584 ], [ %583, %565 ]
  %597 = fmul contract <16 x float> %483, %483
  %598 = fcmp contract olt <16 x float> %596, %597
  %599 = bitcast <16 x i1> %598 to i16
  %600 = icmp eq i16 %599, 0
  br i1 %600, label %713, label %601

601:
  %602 = load i64, ptr %465, align 8
  %603 = load i64, ptr %466, align 8
  %604 = icmp slt i64 %602, %603
  br i1 %604, label %605, label %708

605:
  %606 = getelementptr inbounds i8, ptr %470, i64 52
  br label %610

607:
  %608 = add i64 %612, 1
  %609 = icmp eq i64 %608, %603
  br i1 %609, label %708, label %610

610:
  %611 = phi <16 x i32> [ %468, %605 ], [ %704, %607 ]
  %612 = phi i64 [ %602, %605 ], [ %608, %607 ]
  %613 = getelementptr inbounds %struct.Sphere, ptr %138, i64 %612
  %614 = getelementptr inbounds i8, ptr %613, i64 12
  %615 = load float, ptr %614, align 4
  %616 = fadd contract float %475, %615
  %617 = insertelement <16 x float> poison, float %616, i64 0
  %618 = shufflevector <16 x float> %617, <16 x float> poison, <16 x i32> zeroinitializer
  %619 = fadd contract <16 x float> %461, %618
  %620 = fcmp contract ogt <16 x float> %619, %123
  %621 = select contract <16 x i1> %620, <16 x float> %619, <16 x float> %123
  %622 = load float, ptr %613, align 4
  %623 = getelementptr inbounds i8, ptr %613, i64 4
  %624 = load float, ptr %623, align 4
  %625 = getelementptr inbounds i8, ptr %613, i64 8
  %626 = load float, ptr %625, align 4
  %627 = insertelement <16 x float> poison, float %622, i64 0
  %628 = shufflevector <16 x float> %627, <16 x float> poison, <16 x i32> zeroinitializer
  %629 = fmul contract <16 x float> %407, %628
  %630 = fadd contract <16 x float> %406, %629
  %631 = insertelement <16 x float> poison, float %624, i64 0
  %632 = shufflevector <16 x float> %631, <16 x float> poison, <16 x i32> zeroinitializer
  %633 = fmul contract <16 x float> %413, %632
  %634 = fadd contract <16 x float> %630, %633
  %635 = insertelement <16 x float> poison, float %626, i64 0
  %636 = shufflevector <16 x float> %635, <16 x float> poison, <16 x i32> zeroinitializer
  %637 = fmul contract <16 x float> %419, %636
  %638 = fadd contract <16 x float> %634, %637
  %639 = fmul contract <16 x float> %427, %628
  %640 = fadd contract <16 x float> %425, %639
  %641 = fmul contract <16 x float> %431, %632
  %642 = fadd contract <16 x float> %640, %641
  %643 = fmul contract <16 x float> %435, %636
  %644 = fadd contract <16 x float> %642, %643
  %645 = fmul contract <16 x float> %441, %628
  %646 = fadd contract <16 x float> %439, %645
  %647 = fmul contract <16 x float> %445, %632
  %648 = fadd contract <16 x float> %646, %647
  %649 = fmul contract <16 x float> %449, %636
  %650 = fadd contract <16 x float> %648, %649
  %651 = fmul contract <16 x float> %490, %638
  %652 = fadd contract <16 x float> %487, %651
  %653 = fmul contract <16 x float> %496, %644
  %654 = fadd contract <16 x float> %653, %652
  %655 = fmul contract <16 x float> %502, %650
  %656 = fadd contract <16 x float> %655, %654
  %657 = fmul contract <16 x float> %512, %638
  %658 = fadd contract <16 x float> %508, %657
  %659 = fmul contract <16 x float> %518, %644
  %660 = fadd contract <16 x float> %659, %658
  %661 = fmul contract <16 x float> %524, %650
  %662 = fadd contract <16 x float> %661, %660
  %663 = fmul contract <16 x float> %534, %638
  %664 = fadd contract <16 x float> %530, %663
  %665 = fmul contract <16 x float> %540, %644
  %666 = fadd contract <16 x float> %665, %664
  %667 = fmul contract <16 x float> %546, %650
  %668 = fadd contract <16 x float> %667, %666
  %669 = fmul contract <16 x float> %656, zeroinitializer
  %670 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %668)
  %671 = select contract i1 %552, <16 x float> %668, <16 x float> %670
  br i1 %557, label %672, label %677

672:
  %673 = fmul contract <16 x float> %656, %656
  %674 = fmul contract <16 x float> %662, %662
  %675 = fadd contract <16 x float> %673, %674
  %676 = tail call contract noundef <16 x float> @llvm.sqrt.v16f32(<16 x float> %675)
  br label %679

677:
  %678 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %656)
  br label %679

679:
  %680 = phi contract <16 x float> [ %676, %672 ], [ %678, %677 ]
  %681 = fsub contract <16 x float> %680, %570
  %682 = fcmp contract ogt <16 x float> %681, %669
  %683 = select contract <16 x i1> %682, <16 x float> %681, <16 x float> %669
  %684 = fsub contract <16 x float> %671, %577
  %685 = fcmp contract ogt <16 x float> %684, %669
  %686 = select contract <16 x i1> %685, <16 x float> %684, <16 x float> %669
  %687 = fmul contract <16 x float> %683, %683
  %688 = fmul contract <16 x float> %686, %686
  %689 = fadd contract <16 x float> %688, %687
  br i1 %557, label %700, label %690

690:
  %691 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %662)
  %692 = load float, ptr %606, align 4
  %693 = insertelement <16 x float> poison, float %692, i64 0
  %694 = shufflevector <16 x float> %693, <16 x float> poison, <16 x i32> zeroinitializer
  %695 = fsub contract <16 x float> %691, %694
  %696 = fcmp contract ogt <16 x float> %695, %669
  %697 = select contract <16 x i1> %696, <16 x float> %695, <16 x float> %669
  %698 = fmul contract <16 x float> %697, %697
  %699 = fadd contract <16 x float> %689, %698
  br label %700

700:
  %701 = phi <16 x float> [ %699, %690 ], [ %689, %679 ]
  %702 = fmul contract <16 x float> %621, %621
  %703 = fcmp contract olt <16 x float> %701, %702
  %704 = select <16 x i1> %703, <16 x i32> <i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1>, <16 x i32> %611
  %705 = icmp ne <16 x i32> %704, zeroinitializer
  %706 = bitcast <16 x i1> %705 to i16
  %707 = icmp eq i16 %706, 0
  br i1 %707, label %607, label %1229

708:
  %709 = phi <16 x i32> [ %468, %601 ], [ %704, %607 ]
  %710 = icmp eq <16 x i32> %709, zeroinitializer
  %711 = bitcast <16 x i1> %710 to i16
  %712 = icmp eq i16 %711, 0
  br i1 %712, label %1229, label %713

713:
  %714 = phi <16 x i32> [ %709, %708 ], [ %468, %595 ], [ %468, %467 ]
  %715 = add nuw nsw i64 %469, 1
  %716 = icmp eq i64 %715, %129
  br i1 %716, label %717, label %467

717:
  %718 = phi <16 x i32> [ %392, %391 ], [ %392, %398 ], [ %714, %713 ]
  %719 = add nuw i64 %393, 1
  %720 = icmp eq i64 %393, %12
  br i1 %720, label %721, label %391

721:
  %722 = phi <16 x i32> [ zeroinitializer, %390 ], [ zeroinitializer, %186 ], [ %718, %717 ]
  call void @llvm.lifetime.start.p0(i64 36864, ptr nonnull %6)
  br i1 %21, label %723, label %1227

723:
  %724 = phi <16 x i32> [ %1222, %1221 ], [ %722, %721 ]
  %725 = phi i64 [ %1223, %1221 ], [ 0, %721 ]
  %726 = phi i64 [ %1224, %1221 ], [ 0, %721 ]
  %727 = getelementptr inbounds %struct.LinkPair, ptr %140, i64 %726
  %728 = load i64, ptr %727, align 8
  %729 = getelementptr inbounds %struct.Sphere, ptr %142, i64 %728
  %730 = getelementptr inbounds i8, ptr %727, i64 8
  %731 = load i64, ptr %730, align 8
  %732 = getelementptr inbounds %struct.Sphere, ptr %142, i64 %731
  %733 = getelementptr inbounds %struct.Frame, ptr %10, i64 %728
  %734 = getelementptr inbounds %struct.Frame, ptr %10, i64 %731
  %735 = getelementptr inbounds [136 x float], ptr %11, i64 0, i64 %726
  %736 = load float, ptr %735, align 4
  %737 = insertelement <16 x float> poison, float %736, i64 0
  %738 = shufflevector <16 x float> %737, <16 x float> poison, <16 x i32> zeroinitializer
  %739 = fmul contract <16 x float> %122, %738
  %740 = getelementptr inbounds [136 x float], ptr %143, i64 0, i64 %726
  %741 = load float, ptr %740, align 4
  %742 = getelementptr inbounds float, ptr %145, i64 %726
  %743 = load float, ptr %742, align 4
  %744 = fadd contract float %741, %743
  %745 = insertelement <16 x float> poison, float %744, i64 0
  %746 = shufflevector <16 x float> %745, <16 x float> poison, <16 x i32> zeroinitializer
  %747 = fadd contract <16 x float> %739, %746
  %748 = load float, ptr %732, align 4
  %749 = getelementptr inbounds i8, ptr %732, i64 4
  %750 = load float, ptr %749, align 4
  %751 = getelementptr inbounds i8, ptr %732, i64 8
  %752 = load float, ptr %751, align 4
  %753 = getelementptr inbounds i8, ptr %734, i64 576
  %754 = load <16 x float>, ptr %753, align 64
  %755 = load <16 x float>, ptr %734, align 64
  %756 = insertelement <16 x float> poison, float %748, i64 0
  %757 = shufflevector <16 x float> %756, <16 x float> poison, <16 x i32> zeroinitializer
  %758 = fmul contract <16 x float> %757, %755
  %759 = fadd contract <16 x float> %754, %758
  %760 = getelementptr inbounds i8, ptr %734, i64 64
  %761 = load <16 x float>, ptr %760, align 64
  %762 = insertelement <16 x float> poison, float %750, i64 0
  %763 = shufflevector <16 x float> %762, <16 x float> poison, <16 x i32> zeroinitializer
  %764 = fmul contract <16 x float> %763, %761
  %765 = fadd contract <16 x float> %759, %764
  %766 = getelementptr inbounds i8, ptr %734, i64 128
  %767 = load <16 x float>, ptr %766, align 64
  %768 = insertelement <16 x float> poison, float %752, i64 0
  %769 = shufflevector <16 x float> %768, <16 x float> poison, <16 x i32> zeroinitializer
  %770 = fmul contract <16 x float> %769, %767
  %771 = fadd contract <16 x float> %765, %770
  %772 = getelementptr inbounds i8, ptr %734, i64 640
  %773 = load <16 x float>, ptr %772, align 64
  %774 = getelementptr inbounds i8, ptr %734, i64 192
  %775 = load <16 x float>, ptr %774, align 64
  %776 = fmul contract <16 x float> %757, %775
  %777 = fadd contract <16 x float> %773, %776
  %778 = getelementptr inbounds i8, ptr %734, i64 256
  %779 = load <16 x float>, ptr %778, align 64
  %780 = fmul contract <16 x float> %763, %779
  %781 = fadd contract <16 x float> %777, %780
  %782 = getelementptr inbounds i8, ptr %734, i64 320
  %783 = load <16 x float>, ptr %782, align 64
  %784 = fmul contract <16 x float> %769, %783
  %785 = fadd contract <16 x float> %781, %784
  %786 = getelementptr inbounds i8, ptr %734, i64 704
  %787 = load <16 x float>, ptr %786, align 64
  %788 = getelementptr inbounds i8, ptr %734, i64 384
  %789 = load <16 x float>, ptr %788, align 64
  %790 = fmul contract <16 x float> %757, %789
  %791 = fadd contract <16 x float> %787, %790
  %792 = getelementptr inbounds i8, ptr %734, i64 448
  %793 = load <16 x float>, ptr %792, align 64
  %794 = fmul contract <16 x float> %763, %793
  %795 = fadd contract <16 x float> %791, %794
  %796 = getelementptr inbounds i8, ptr %734, i64 512
  %797 = load <16 x float>, ptr %796, align 64
  %798 = fmul contract <16 x float> %769, %797
  %799 = fadd contract <16 x float> %795, %798
  %800 = getelementptr inbounds i8, ptr %729, i64 12
  %801 = load float, ptr %800, align 4
  %802 = getelementptr inbounds i8, ptr %732, i64 12
  %803 = load float, ptr %802, align 4
  %804 = fadd contract float %801, %803
  %805 = insertelement <16 x float> poison, float %804, i64 0
  %806 = shufflevector <16 x float> %805, <16 x float> poison, <16 x i32> zeroinitializer
  %807 = fadd contract <16 x float> %747, %806
  %808 = fcmp contract ogt <16 x float> %807, %123
  %809 = select contract <16 x i1> %808, <16 x float> %807, <16 x float> %123
  %810 = load float, ptr %729, align 4
  %811 = getelementptr inbounds i8, ptr %729, i64 4
  %812 = load float, ptr %811, align 4
  %813 = getelementptr inbounds i8, ptr %729, i64 8
  %814 = load float, ptr %813, align 4
  %815 = getelementptr inbounds i8, ptr %733, i64 576
  %816 = load <16 x float>, ptr %815, align 64
  %817 = load <16 x float>, ptr %733, align 64
  %818 = insertelement <16 x float> poison, float %810, i64 0
  %819 = shufflevector <16 x float> %818, <16 x float> poison, <16 x i32> zeroinitializer
  %820 = fmul contract <16 x float> %819, %817
  %821 = fadd contract <16 x float> %816, %820
  %822 = getelementptr inbounds i8, ptr %733, i64 64
  %823 = load <16 x float>, ptr %822, align 64
  %824 = insertelement <16 x float> poison, float %812, i64 0
  %825 = shufflevector <16 x float> %824, <16 x float> poison, <16 x i32> zeroinitializer
  %826 = fmul contract <16 x float> %825, %823
  %827 = fadd contract <16 x float> %821, %826
  %828 = getelementptr inbounds i8, ptr %733, i64 128
  %829 = load <16 x float>, ptr %828, align 64
  %830 = insertelement <16 x float> poison, float %814, i64 0
  %831 = shufflevector <16 x float> %830, <16 x float> poison, <16 x i32> zeroinitializer
  %832 = fmul contract <16 x float> %831, %829
  %833 = fadd contract <16 x float> %827, %832
  %834 = getelementptr inbounds i8, ptr %733, i64 640
  %835 = load <16 x float>, ptr %834, align 64
  %836 = getelementptr inbounds i8, ptr %733, i64 192
  %837 = load <16 x float>, ptr %836, align 64
  %838 = fmul contract <16 x float> %819, %837
  %839 = fadd contract <16 x float> %835, %838
  %840 = getelementptr inbounds i8, ptr %733, i64 256
  %841 = load <16 x float>, ptr %840, align 64
  %842 = fmul contract <16 x float> %825, %841
  %843 = fadd contract <16 x float> %839, %842
  %844 = getelementptr inbounds i8, ptr %733, i64 320
  %845 = load <16 x float>, ptr %844, align 64
  %846 = fmul contract <16 x float> %831, %845
  %847 = fadd contract <16 x float> %843, %846
  %848 = getelementptr inbounds i8, ptr %733, i64 704
  %849 = load <16 x float>, ptr %848, align 64
  %850 = getelementptr inbounds i8, ptr %733, i64 384
  %851 = load <16 x float>, ptr %850, align 64
  %852 = fmul contract <16 x float> %819, %851
  %853 = fadd contract <16 x float> %849, %852
  %854 = getelementptr inbounds i8, ptr %733, i64 448
  %855 = load <16 x float>, ptr %854, align 64
  %856 = fmul contract <16 x float> %825, %855
  %857 = fadd contract <16 x float> %853, %856
  %858 = getelementptr inbounds i8, ptr %733, i64 512
  %859 = load <16 x float>, ptr %858, align 64
  %860 = fmul contract <16 x float> %831, %859
  %861 = fadd contract <16 x float> %857, %860
  %862 = fsub contract <16 x float> %833, %771
  %863 = fsub contract <16 x float> %847, %785
  %864 = fsub contract <16 x float> %861, %799
  %865 = fmul contract <16 x float> %862, %862
  %866 = fmul contract <16 x float> %863, %863
  %867 = fadd contract <16 x float> %865, %866
  %868 = fmul contract <16 x float> %864, %864
  %869 = fadd contract <16 x float> %867, %868
  %870 = fmul contract <16 x float> %809, %809
  %871 = fcmp contract olt <16 x float> %869, %870
  %872 = bitcast <16 x i1> %871 to i16
  %873 = icmp eq i16 %872, 0
  br i1 %873, label %1221, label %874

874:
  call void @llvm.lifetime.start.p0(i64 16, ptr nonnull %7)
  store i64 %728, ptr %7, align 16
  store i64 %731, ptr %146, align 8
  br label %881

875:
  %876 = getelementptr inbounds i8, ptr %727, i64 16
  %877 = load i64, ptr %876, align 8
  %878 = getelementptr inbounds i8, ptr %727, i64 24
  %879 = load i64, ptr %878, align 8
  %880 = icmp slt i64 %877, %879
  br i1 %880, label %962, label %1219

881:
  %882 = phi i64 [ %725, %874 ], [ %959, %958 ]
  %883 = phi i64 [ 0, %874 ], [ %960, %958 ]
  %884 = getelementptr inbounds i8, ptr %7, i64 %883
  %885 = load i64, ptr %884, align 8
  %886 = shl nuw i64 1, %885
  %887 = and i64 %886, %882
  %888 = icmp eq i64 %887, 0
  br i1 %888, label %889, label %958

889:
  %890 = or i64 %886, %882
  %891 = getelementptr inbounds i64, ptr %148, i64 %885
  %892 = load i64, ptr %891, align 8
  %893 = getelementptr i8, ptr %891, i64 8
  %894 = load i64, ptr %893, align 8
  %895 = icmp slt i64 %892, %894
  br i1 %895, label %896, label %958

896:
  %897 = getelementptr inbounds %struct.Frame, ptr %10, i64 %885
  %898 = getelementptr inbounds i8, ptr %897, i64 576
  %899 = load <16 x float>, ptr %898, align 64
  %900 = load <16 x float>, ptr %897, align 64
  %901 = getelementptr inbounds i8, ptr %897, i64 64
  %902 = load <16 x float>, ptr %901, align 64
  %903 = getelementptr inbounds i8, ptr %897, i64 128
  %904 = load <16 x float>, ptr %903, align 64
  %905 = getelementptr inbounds i8, ptr %897, i64 640
  %906 = load <16 x float>, ptr %905, align 64
  %907 = getelementptr inbounds i8, ptr %897, i64 192
  %908 = load <16 x float>, ptr %907, align 64
  %909 = getelementptr inbounds i8, ptr %897, i64 256
  %910 = load <16 x float>, ptr %909, align 64
  %911 = getelementptr inbounds i8, ptr %897, i64 320
  %912 = load <16 x float>, ptr %911, align 64
  %913 = getelementptr inbounds i8, ptr %897, i64 704
  %914 = load <16 x float>, ptr %913, align 64
  %915 = getelementptr inbounds i8, ptr %897, i64 384
  %916 = load <16 x float>, ptr %915, align 64
  %917 = getelementptr inbounds i8, ptr %897, i64 448
  %918 = load <16 x float>, ptr %917, align 64
  %919 = getelementptr inbounds i8, ptr %897, i64 512
  %920 = load <16 x float>, ptr %919, align 64
  br label %921

921:
  %922 = phi i64 [ %892, %896 ], [ %956, %921 ]
  %923 = getelementptr inbounds %struct.Part, ptr %150, i64 %922
  %924 = load float, ptr %923, align 4
  %925 = getelementptr inbounds i8, ptr %923, i64 4
  %926 = load float, ptr %925, align 4
  %927 = getelementptr inbounds i8, ptr %923, i64 8
  %928 = load float, ptr %927, align 4
  %929 = insertelement <16 x float> poison, float %924, i64 0
  %930 = shufflevector <16 x float> %929, <16 x float> poison, <16 x i32> zeroinitializer
  %931 = fmul contract <16 x float> %930, %900
  %932 = fadd contract <16 x float> %899, %931
  %933 = insertelement <16 x float> poison, float %926, i64 0
  %934 = shufflevector <16 x float> %933, <16 x float> poison, <16 x i32> zeroinitializer
  %935 = fmul contract <16 x float> %934, %902
  %936 = fadd contract <16 x float> %932, %935
  %937 = insertelement <16 x float> poison, float %928, i64 0
  %938 = shufflevector <16 x float> %937, <16 x float> poison, <16 x i32> zeroinitializer
  %939 = fmul contract <16 x float> %938, %904
  %940 = fadd contract <16 x float> %936, %939
  %941 = fmul contract <16 x float> %930, %908
  %942 = fadd contract <16 x float> %906, %941
  %943 = fmul contract <16 x float> %934, %910
  %944 = fadd contract <16 x float> %942, %943
  %945 = fmul contract <16 x float> %938, %912
  %946 = fadd contract <16 x float> %944, %945
  %947 = fmul contract <16 x float> %930, %916
  %948 = fadd contract <16 x float> %914, %947
  %949 = fmul contract <16 x float> %934, %918
  %950 = fadd contract <16 x float> %948, %949
  %951 = fmul contract <16 x float> %938, %920
  %952 = fadd contract <16 x float> %950, %951
  %953 = getelementptr inbounds [192 x %struct.Point], ptr %6, i64 0, i64 %922
  store <16 x float> %940, ptr %953, align 64
  %954 = getelementptr inbounds i8, ptr %953, i64 64
  store <16 x float> %946, ptr %954, align 64
  %955 = getelementptr inbounds i8, ptr %953, i64 128
  store <16 x float> %952, ptr %955, align 64
  %956 = add nsw i64 %922, 1
  %957 = icmp eq i64 %956, %894
  br i1 %957, label %958, label %921

958:
  %959 = phi i64 [ %882, %881 ], [ %890, %889 ], [ %890, %921 ]
  %960 = add nuw nsw i64 %883, 8
  %961 = icmp eq i64 %960, 16
  br i1 %961, label %875, label %881

962:
  %963 = phi <16 x i32> [ %1216, %1213 ], [ %724, %875 ]
  %964 = phi i64 [ %1217, %1213 ], [ %877, %875 ]
  %965 = phi i1 [ %1214, %1213 ], [ false, %875 ]
  %966 = phi i64 [ %1215, %1213 ], [ -1, %875 ]
  %967 = getelementptr inbounds %struct.PartPair, ptr %152, i64 %964
  %968 = load i64, ptr %967, align 8
  %969 = getelementptr inbounds %struct.Part, ptr %150, i64 %968
  %970 = getelementptr inbounds i8, ptr %967, i64 8
  %971 = load i64, ptr %970, align 8
  %972 = getelementptr inbounds %struct.Part, ptr %150, i64 %971
  %973 = icmp eq i64 %968, %966
  br i1 %973, label %1001, label %974

974:
  %975 = getelementptr inbounds i8, ptr %969, i64 28
  %976 = load float, ptr %975, align 4
  %977 = fadd contract float %803, %976
  %978 = insertelement <16 x float> poison, float %977, i64 0
  %979 = shufflevector <16 x float> %978, <16 x float> poison, <16 x i32> zeroinitializer
  %980 = fadd contract <16 x float> %747, %979
  %981 = fcmp contract ogt <16 x float> %980, %123
  %982 = select contract <16 x i1> %981, <16 x float> %980, <16 x float> %123
  %983 = getelementptr inbounds [192 x %struct.Point], ptr %6, i64 0, i64 %968
  %984 = load <16 x float>, ptr %983, align 64
  %985 = fsub contract <16 x float> %984, %771
  %986 = getelementptr inbounds i8, ptr %983, i64 64
  %987 = load <16 x float>, ptr %986, align 64
  %988 = fsub contract <16 x float> %987, %785
  %989 = getelementptr inbounds i8, ptr %983, i64 128
  %990 = load <16 x float>, ptr %989, align 64
  %991 = fsub contract <16 x float> %990, %799
  %992 = fmul contract <16 x float> %985, %985
  %993 = fmul contract <16 x float> %988, %988
  %994 = fadd contract <16 x float> %992, %993
  %995 = fmul contract <16 x float> %991, %991
  %996 = fadd contract <16 x float> %994, %995
  %997 = fmul contract <16 x float> %982, %982
  %998 = fcmp contract olt <16 x float> %996, %997
  %999 = bitcast <16 x i1> %998 to i16
  %1000 = icmp eq i16 %999, 0
  br i1 %1000, label %1213, label %1002

1001:
  br i1 %965, label %1002, label %1213

1002:
  %1003 = phi i64 [ %968, %974 ], [ %966, %1001 ]
  %1004 = getelementptr inbounds i8, ptr %969, i64 28
  %1005 = load float, ptr %1004, align 4
  %1006 = getelementptr inbounds i8, ptr %972, i64 28
  %1007 = load float, ptr %1006, align 4
  %1008 = fadd contract float %1005, %1007
  %1009 = insertelement <16 x float> poison, float %1008, i64 0
  %1010 = shufflevector <16 x float> %1009, <16 x float> poison, <16 x i32> zeroinitializer
  %1011 = fadd contract <16 x float> %747, %1010
  %1012 = fcmp contract ogt <16 x float> %1011, %123
  %1013 = select contract <16 x i1> %1012, <16 x float> %1011, <16 x float> %123
  %1014 = getelementptr inbounds [192 x %struct.Point], ptr %6, i64 0, i64 %968
  %1015 = getelementptr inbounds [192 x %struct.Point], ptr %6, i64 0, i64 %971
  %1016 = load <16 x float>, ptr %1014, align 64
  %1017 = load <16 x float>, ptr %1015, align 64
  %1018 = fsub contract <16 x float> %1016, %1017
  %1019 = getelementptr inbounds i8, ptr %1014, i64 64
  %1020 = load <16 x float>, ptr %1019, align 64
  %1021 = getelementptr inbounds i8, ptr %1015, i64 64
  %1022 = load <16 x float>, ptr %1021, align 64
  %1023 = fsub contract <16 x float> %1020, %1022
  %1024 = getelementptr inbounds i8, ptr %1014, i64 128
  %1025 = load <16 x float>, ptr %1024, align 64
  %1026 = getelementptr inbounds i8, ptr %1015, i64 128
  %1027 = load <16 x float>, ptr %1026, align 64
  %1028 = fsub contract <16 x float> %1025, %1027
  %1029 = fmul contract <16 x float> %1018, %1018
  %1030 = fmul contract <16 x float> %1023, %1023
  %1031 = fadd contract <16 x float> %1029, %1030
  %1032 = fmul contract <16 x float> %1028, %1028
  %1033 = fadd contract <16 x float> %1031, %1032
  %1034 = fmul contract <16 x float> %1013, %1013
  %1035 = fcmp contract olt <16 x float> %1033, %1034
  %1036 = bitcast <16 x i1> %1035 to i16
  %1037 = icmp eq i16 %1036, 0
  br i1 %1037, label %1213, label %1038

1038:
  %1039 = getelementptr inbounds i8, ptr %969, i64 24
  %1040 = load float, ptr %1039, align 4
  %1041 = getelementptr inbounds i8, ptr %972, i64 24
  %1042 = load float, ptr %1041, align 4
  %1043 = fadd contract float %1040, %1042
  %1044 = insertelement <16 x float> poison, float %1043, i64 0
  %1045 = shufflevector <16 x float> %1044, <16 x float> poison, <16 x i32> zeroinitializer
  %1046 = fadd contract <16 x float> %747, %1045
  %1047 = fcmp contract ogt <16 x float> %1046, %123
  %1048 = select contract <16 x i1> %1047, <16 x float> %1046, <16 x float> %123
  %1049 = getelementptr inbounds i8, ptr %969, i64 12
  %1050 = load float, ptr %1049, align 4
  %1051 = fmul contract float %1050, %1050
  %1052 = getelementptr inbounds i8, ptr %969, i64 16
  %1053 = load float, ptr %1052, align 4
  %1054 = fmul contract float %1053, %1053
  %1055 = fadd contract float %1051, %1054
  %1056 = getelementptr inbounds i8, ptr %969, i64 20
  %1057 = load float, ptr %1056, align 4
  %1058 = fmul contract float %1057, %1057
  %1059 = fadd contract float %1055, %1058
  %1060 = getelementptr inbounds i8, ptr %972, i64 12
  %1061 = load float, ptr %1060, align 4
  %1062 = fmul contract float %1061, %1061
  %1063 = getelementptr inbounds i8, ptr %972, i64 16
  %1064 = load float, ptr %1063, align 4
  %1065 = fmul contract float %1064, %1064
  %1066 = fadd contract float %1062, %1065
  %1067 = getelementptr inbounds i8, ptr %972, i64 20
  %1068 = load float, ptr %1067, align 4
  %1069 = fmul contract float %1068, %1068
  %1070 = fadd contract float %1066, %1069
  %1071 = fcmp contract oeq float %1059, 0.000000e+00
  %1072 = fcmp contract oeq float %1070, 0.000000e+00
  %1073 = select i1 %1071, i1 %1072, i1 false
  br i1 %1073, label %1205, label %1074

1074:
  %1075 = fmul contract <16 x float> %1016, zeroinitializer
  %1076 = fadd contract <16 x float> %1075, <float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01>
  %1077 = insertelement <16 x float> poison, float %1050, i64 0
  %1078 = shufflevector <16 x float> %1077, <16 x float> poison, <16 x i32> zeroinitializer
  %1079 = fmul contract <16 x float> %817, %1078
  %1080 = insertelement <16 x float> poison, float %1053, i64 0
  %1081 = shufflevector <16 x float> %1080, <16 x float> poison, <16 x i32> zeroinitializer
  %1082 = fmul contract <16 x float> %823, %1081
  %1083 = fadd contract <16 x float> %1079, %1082
  %1084 = insertelement <16 x float> poison, float %1057, i64 0
  %1085 = shufflevector <16 x float> %1084, <16 x float> poison, <16 x i32> zeroinitializer
  %1086 = fmul contract <16 x float> %829, %1085
  %1087 = fadd contract <16 x float> %1083, %1086
  %1088 = fmul contract <16 x float> %837, %1078
  %1089 = fmul contract <16 x float> %841, %1081
  %1090 = fadd contract <16 x float> %1088, %1089
  %1091 = fmul contract <16 x float> %845, %1085
  %1092 = fadd contract <16 x float> %1090, %1091
  %1093 = fmul contract <16 x float> %851, %1078
  %1094 = fmul contract <16 x float> %855, %1081
  %1095 = fadd contract <16 x float> %1093, %1094
  %1096 = fmul contract <16 x float> %859, %1085
  %1097 = fadd contract <16 x float> %1095, %1096
  %1098 = insertelement <16 x float> poison, float %1061, i64 0
  %1099 = shufflevector <16 x float> %1098, <16 x float> poison, <16 x i32> zeroinitializer
  %1100 = fmul contract <16 x float> %755, %1099
  %1101 = insertelement <16 x float> poison, float %1064, i64 0
  %1102 = shufflevector <16 x float> %1101, <16 x float> poison, <16 x i32> zeroinitializer
  %1103 = fmul contract <16 x float> %761, %1102
  %1104 = fadd contract <16 x float> %1100, %1103
  %1105 = insertelement <16 x float> poison, float %1068, i64 0
  %1106 = shufflevector <16 x float> %1105, <16 x float> poison, <16 x i32> zeroinitializer
  %1107 = fmul contract <16 x float> %767, %1106
  %1108 = fadd contract <16 x float> %1104, %1107
  %1109 = fmul contract <16 x float> %775, %1099
  %1110 = fmul contract <16 x float> %779, %1102
  %1111 = fadd contract <16 x float> %1109, %1110
  %1112 = fmul contract <16 x float> %783, %1106
  %1113 = fadd contract <16 x float> %1111, %1112
  %1114 = fmul contract <16 x float> %789, %1099
  %1115 = fmul contract <16 x float> %793, %1102
  %1116 = fadd contract <16 x float> %1114, %1115
  %1117 = fmul contract <16 x float> %797, %1106
  %1118 = fadd contract <16 x float> %1116, %1117
  %1119 = fcmp contract ogt float %1059, 0.000000e+00
  %1120 = fdiv contract float 1.000000e+00, %1059
  %1121 = select contract i1 %1119, float %1120, float 0.000000e+00
  %1122 = fcmp contract ogt float %1070, 0.000000e+00
  %1123 = fdiv contract float 1.000000e+00, %1070
  %1124 = select contract i1 %1122, float %1123, float 0.000000e+00
  %1125 = fmul contract <16 x float> %1087, %1108
  %1126 = fmul contract <16 x float> %1092, %1113
  %1127 = fadd contract <16 x float> %1125, %1126
  %1128 = fmul contract <16 x float> %1097, %1118
  %1129 = fadd contract <16 x float> %1128, %1127
  %1130 = fmul contract <16 x float> %1018, %1087
  %1131 = fmul contract <16 x float> %1023, %1092
  %1132 = fadd contract <16 x float> %1130, %1131
  %1133 = fmul contract <16 x float> %1028, %1097
  %1134 = fadd contract <16 x float> %1133, %1132
  %1135 = fmul contract <16 x float> %1018, %1108
  %1136 = fmul contract <16 x float> %1023, %1113
  %1137 = fadd contract <16 x float> %1135, %1136
  %1138 = fmul contract <16 x float> %1028, %1118
  %1139 = fadd contract <16 x float> %1138, %1137
  %1140 = fmul contract float %1059, %1070
  %1141 = insertelement <16 x float> poison, float %1140, i64 0
  %1142 = shufflevector <16 x float> %1141, <16 x float> poison, <16 x i32> zeroinitializer
  %1143 = fmul contract <16 x float> %1129, %1129
  %1144 = fsub contract <16 x float> %1142, %1143
  %1145 = fmul contract float %1059, 0x3E7AD7F2A0000000
  %1146 = fmul contract float %1145, %1070
  %1147 = insertelement <16 x float> poison, float %1146, i64 0
  %1148 = shufflevector <16 x float> %1147, <16 x float> poison, <16 x i32> zeroinitializer
  %1149 = fcmp contract ogt <16 x float> %1144, %1148
  %1150 = fmul contract <16 x float> %1129, %1139
  %1151 = insertelement <16 x float> poison, float %1070, i64 0
  %1152 = shufflevector <16 x float> %1151, <16 x float> poison, <16 x i32> zeroinitializer
  %1153 = fmul contract <16 x float> %1152, %1134
  %1154 = fsub contract <16 x float> %1150, %1153
  %1155 = select contract <16 x i1> %1149, <16 x float> %1144, <16 x float> %1076
  %1156 = fdiv contract <16 x float> %1154, %1155
  %1157 = fneg contract <16 x float> %1076
  %1158 = fcmp contract ogt <16 x float> %1156, %1157
  %1159 = select contract <16 x i1> %1158, <16 x float> %1156, <16 x float> %1157
  %1160 = fcmp contract olt <16 x float> %1159, %1076
  %1161 = select contract <16 x i1> %1160, <16 x float> %1159, <16 x float> %1076
  %1162 = select contract <16 x i1> %1149, <16 x float> %1161, <16 x float> %1157
  %1163 = fmul contract <16 x float> %1129, %1162
  %1164 = fadd contract <16 x float> %1139, %1163
  %1165 = insertelement <16 x float> poison, float %1124, i64 0
  %1166 = shufflevector <16 x float> %1165, <16 x float> poison, <16 x i32> zeroinitializer
  %1167 = fmul contract <16 x float> %1166, %1164
  %1168 = fcmp contract ogt <16 x float> %1167, %1157
  %1169 = select contract <16 x i1> %1168, <16 x float> %1167, <16 x float> %1157
  %1170 = fcmp contract olt <16 x float> %1169, %1076
  %1171 = select contract <16 x i1> %1170, <16 x float> %1169, <16 x float> %1076
  %1172 = fmul contract <16 x float> %1129, %1171
  %1173 = fsub contract <16 x float> %1172, %1134
  %1174 = insertelement <16 x float> poison, float %1121, i64 0
  %1175 = shufflevector <16 x float> %1174, <16 x float> poison, <16 x i32> zeroinitializer
  %1176 = fmul contract <16 x float> %1175, %1173
  %1177 = fcmp contract ogt <16 x float> %1176, %1157
  %1178 = select contract <16 x i1> %1177, <16 x float> %1176, <16 x float> %1157
  %1179 = fcmp contract olt <16 x float> %1178, %1076
  %1180 = select contract <16 x i1> %1179, <16 x float> %1178, <16 x float> %1076
  %1181 = fmul contract <16 x float> %1129, %1180
  %1182 = fadd contract <16 x float> %1139, %1181
  %1183 = fmul contract <16 x float> %1166, %1182
  %1184 = fcmp contract ogt <16 x float> %1183, %1157
  %1185 = select contract <16 x i1> %1184, <16 x float> %1183, <16 x float> %1157
  %1186 = fcmp contract olt <16 x float> %1185, %1076
  %1187 = select contract <16 x i1> %1186, <16 x float> %1185, <16 x float> %1076
  %1188 = fmul contract <16 x float> %1087, %1180
  %1189 = fadd contract <16 x float> %1018, %1188
  %1190 = fmul contract <16 x float> %1108, %1187
  %1191 = fsub contract <16 x float> %1189, %1190
  %1192 = fmul contract <16 x float> %1092, %1180
  %1193 = fadd contract <16 x float> %1023, %1192
  %1194 = fmul contract <16 x float> %1113, %1187
  %1195 = fsub contract <16 x float> %1193, %1194
  %1196 = fmul contract <16 x float> %1097, %1180
  %1197 = fadd contract <16 x float> %1028, %1196
  %1198 = fmul contract <16 x float> %1118, %1187
  %1199 = fsub contract <16 x float> %1197, %1198
  %1200 = fmul contract <16 x float> %1191, %1191
  %1201 = fmul contract <16 x float> %1195, %1195
  %1202 = fadd contract <16 x float> %1200, %1201
  %1203 = fmul contract <16 x float> %1199, %1199
  %1204 = fadd contract <16 x float> %1203, %1202
  br label %1205

1205:
  %1206 = phi <16 x float> [ %1204, %1074 ], [ %1033, %1038 ]
  %1207 = fmul contract <16 x float> %1048, %1048
  %1208 = fcmp contract olt <16 x float> %1206, %1207
  %1209 = select <16 x i1> %1208, <16 x i32> <i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1>, <16 x i32> %963
  %1210 = icmp ne <16 x i32> %1209, zeroinitializer
  %1211 = bitcast <16 x i1> %1210 to i16
  %1212 = icmp eq i16 %1211, 0
  br i1 %1212, label %1213, label %1226

1213:
  %1214 = phi i1 [ true, %1002 ], [ false, %1001 ], [ true, %1205 ], [ false, %974 ]
  %1215 = phi i64 [ %1003, %1002 ], [ %966, %1001 ], [ %1003, %1205 ], [ %968, %974 ]
  %1216 = phi <16 x i32> [ %963, %1002 ], [ %963, %1001 ], [ %1209, %1205 ], [ %963, %974 ]
  %1217 = add i64 %964, 1
  %1218 = icmp eq i64 %1217, %879
  br i1 %1218, label %1219, label %962

1219:
  %1220 = phi <16 x i32> [ %724, %875 ], [ %1216, %1213 ]
  call void @llvm.lifetime.end.p0(i64 16, ptr nonnull %7)
  br label %1221

1221:
  %1222 = phi <16 x i32> [ %1220, %1219 ], [ %724, %723 ]
  %1223 = phi i64 [ %959, %1219 ], [ %725, %723 ]
  %1224 = add nuw nsw i64 %726, 1
  %1225 = icmp eq i64 %1224, %20
  br i1 %1225, label %1227, label %723

1226:
  call void @llvm.lifetime.end.p0(i64 16, ptr nonnull %7)
  br label %1227

1227:
  %1228 = phi <16 x i32> [ %1209, %1226 ], [ %722, %721 ], [ %1222, %1221 ]
  call void @llvm.lifetime.end.p0(i64 36864, ptr nonnull %6)
  br label %1229

1229:
  %1230 = phi <16 x i32> [ %1228, %1227 ], [ %704, %700 ], [ %709, %708 ]
  %1231 = icmp ne <16 x i32> %1230, zeroinitializer
  %1232 = bitcast <16 x i1> %1231 to i16
  %1233 = icmp eq i16 %1232, 0
  br i1 %1233, label %162, label %1234

1234:
  %1235 = phi i1 [ true, %112 ], [ %164, %162 ], [ %167, %1229 ]
  call void @llvm.lifetime.end.p0(i64 13056, ptr nonnull %10)
  call void @llvm.lifetime.end.p0(i64 1224, ptr nonnull %9)
  ret i1 %1235
}

declare void @llvm.lifetime.end.p0(i64 immarg, ptr nocapture)

define void @prove_edges(ptr nocapture noundef readonly %0, ptr nocapture noundef readonly %1, ptr nocapture noundef readonly %2, ptr nocapture noundef readonly %3, i64 noundef %4, double noundef %5, ptr nocapture noundef writeonly %6) {
  %8 = alloca [192 x %struct.Point.4], align 64
  %9 = alloca [2 x i64], align 16
  %10 = alloca [9 x <8 x double>], align 64
  %11 = alloca %struct.Motion.1, align 8
  %12 = alloca [4096 x %struct.Piece], align 16
  %13 = alloca [17 x %struct.Frame.2], align 64
  %14 = alloca [8 x %struct.Piece], align 16
  %15 = load i64, ptr %0, align 8
  %16 = icmp sgt i64 %4, 0
  br i1 %16, label %17, label %39

17:
  %18 = getelementptr inbounds i8, ptr %11, i64 272
  %19 = getelementptr inbounds i8, ptr %0, i64 112
  %20 = getelementptr inbounds i8, ptr %0, i64 16
  %21 = getelementptr inbounds i8, ptr %0, i64 120
  %22 = getelementptr inbounds i8, ptr %11, i64 136
  %23 = getelementptr inbounds i8, ptr %11, i64 1360
  %24 = getelementptr inbounds i8, ptr %13, i64 576
  %25 = getelementptr inbounds i8, ptr %0, i64 24
  %26 = getelementptr inbounds i8, ptr %0, i64 48
  %27 = getelementptr inbounds i8, ptr %0, i64 8
  %28 = getelementptr inbounds i8, ptr %0, i64 56
  %29 = getelementptr inbounds i8, ptr %0, i64 64
  %30 = getelementptr inbounds i8, ptr %0, i64 32
  %31 = getelementptr inbounds i8, ptr %0, i64 40
  %32 = getelementptr inbounds i8, ptr %0, i64 96
  %33 = getelementptr inbounds i8, ptr %0, i64 88
  %34 = getelementptr inbounds i8, ptr %0, i64 128
  %35 = getelementptr inbounds i8, ptr %9, i64 8
  %36 = getelementptr inbounds i8, ptr %0, i64 80
  %37 = getelementptr inbounds i8, ptr %0, i64 72
  %38 = getelementptr inbounds i8, ptr %0, i64 104
  br label %40

39:
  ret void

40:
  %41 = phi i64 [ 0, %17 ], [ %1339, %1336 ]
  %42 = mul nsw i64 %41, %15
  %43 = getelementptr inbounds double, ptr %1, i64 %42
  %44 = getelementptr inbounds double, ptr %2, i64 %42
  %45 = getelementptr inbounds double, ptr %3, i64 %42
  call void @llvm.lifetime.start.p0(i64 2448, ptr nonnull %11)
  %46 = load i64, ptr %0, align 8
  %47 = icmp slt i64 %46, 0
  br i1 %47, label %51, label %48

48:
  %49 = icmp eq i64 %46, 0
  %50 = load ptr, ptr %19, align 8
  br label %57

51:
  %52 = load i64, ptr %20, align 8
  %53 = icmp sgt i64 %52, 0
  br i1 %53, label %54, label %103

54:
  %55 = icmp sgt i64 %46, 0
  %56 = load ptr, ptr %21, align 8
  br label %80

57:
  %58 = phi i64 [ 0, %48 ], [ %78, %75 ]
  %59 = mul nuw nsw i64 %58, %46
  %60 = getelementptr inbounds double, ptr %50, i64 %59
  br i1 %49, label %75, label %61

61:
  %62 = phi i64 [ %73, %61 ], [ 0, %57 ]
  %63 = phi double [ %72, %61 ], [ 0.000000e+00, %57 ]
  %64 = getelementptr inbounds double, ptr %60, i64 %62
  %65 = load double, ptr %64, align 8
  %66 = getelementptr inbounds double, ptr %44, i64 %62
  %67 = load double, ptr %66, align 8
  %68 = fcmp contract olt double %67, 0.000000e+00
  %69 = fneg contract double %67
  %70 = select contract i1 %68, double %69, double %67
  %71 = fmul contract double %65, %70
  %72 = fadd contract double %63, %71
  %73 = add nuw nsw i64 %62, 1
  %74 = icmp eq i64 %73, %46
  br i1 %74, label %75, label %61

75:
  %76 = phi double [ 0.000000e+00, %57 ], [ %72, %61 ]
  %77 = getelementptr inbounds double, ptr %11, i64 %58
  store double %76, ptr %77, align 8
  %78 = add nuw i64 %58, 1
  %79 = icmp eq i64 %58, %46
  br i1 %79, label %51, label %57

80:
  %81 = phi i64 [ 0, %54 ], [ %101, %98 ]
  %82 = mul nsw i64 %81, %46
  %83 = getelementptr inbounds double, ptr %56, i64 %82
  br i1 %55, label %84, label %98

84:
  %85 = phi i64 [ %96, %84 ], [ 0, %80 ]
  %86 = phi double [ %95, %84 ], [ 0.000000e+00, %80 ]
  %87 = getelementptr inbounds double, ptr %83, i64 %85
  %88 = load double, ptr %87, align 8
  %89 = getelementptr inbounds double, ptr %44, i64 %85
  %90 = load double, ptr %89, align 8
  %91 = fcmp contract olt double %90, 0.000000e+00
  %92 = fneg contract double %90
  %93 = select contract i1 %91, double %92, double %90
  %94 = fmul contract double %88, %93
  %95 = fadd contract double %86, %94
  %96 = add nuw nsw i64 %85, 1
  %97 = icmp eq i64 %96, %46
  br i1 %97, label %98, label %84

98:
  %99 = phi double [ 0.000000e+00, %80 ], [ %95, %84 ]
  %100 = getelementptr inbounds double, ptr %18, i64 %81
  store double %99, ptr %100, align 8
  %101 = add nuw nsw i64 %81, 1
  %102 = icmp eq i64 %101, %52
  br i1 %102, label %103, label %80

103:
  br i1 %47, label %107, label %104

104:
  %105 = icmp eq i64 %46, 0
  %106 = load ptr, ptr %19, align 8
  br label %111

107:
  br i1 %53, label %108, label %157

108:
  %109 = icmp sgt i64 %46, 0
  %110 = load ptr, ptr %21, align 8
  br label %134

111:
  %112 = phi i64 [ 0, %104 ], [ %132, %129 ]
  %113 = mul nuw nsw i64 %112, %46
  %114 = getelementptr inbounds double, ptr %106, i64 %113
  br i1 %105, label %129, label %115

115:
  %116 = phi i64 [ %127, %115 ], [ 0, %111 ]
  %117 = phi double [ %126, %115 ], [ 0.000000e+00, %111 ]
  %118 = getelementptr inbounds double, ptr %114, i64 %116
  %119 = load double, ptr %118, align 8
  %120 = getelementptr inbounds double, ptr %45, i64 %116
  %121 = load double, ptr %120, align 8
  %122 = fcmp contract olt double %121, 0.000000e+00
  %123 = fneg contract double %121
  %124 = select contract i1 %122, double %123, double %121
  %125 = fmul contract double %119, %124
  %126 = fadd contract double %117, %125
  %127 = add nuw nsw i64 %116, 1
  %128 = icmp eq i64 %127, %46
  br i1 %128, label %129, label %115

129:
  %130 = phi double [ 0.000000e+00, %111 ], [ %126, %115 ]
  %131 = getelementptr inbounds double, ptr %22, i64 %112
  store double %130, ptr %131, align 8
  %132 = add nuw i64 %112, 1
  %133 = icmp eq i64 %112, %46
  br i1 %133, label %107, label %111

134:
  %135 = phi i64 [ 0, %108 ], [ %155, %152 ]
  %136 = mul nsw i64 %135, %46
  %137 = getelementptr inbounds double, ptr %110, i64 %136
  br i1 %109, label %138, label %152

138:
  %139 = phi i64 [ %150, %138 ], [ 0, %134 ]
  %140 = phi double [ %149, %138 ], [ 0.000000e+00, %134 ]
  %141 = getelementptr inbounds double, ptr %137, i64 %139
  %142 = load double, ptr %141, align 8
  %143 = getelementptr inbounds double, ptr %45, i64 %139
  %144 = load double, ptr %143, align 8
  %145 = fcmp contract olt double %144, 0.000000e+00
  %146 = fneg contract double %144
  %147 = select contract i1 %145, double %146, double %144
  %148 = fmul contract double %142, %147
  %149 = fadd contract double %140, %148
  %150 = add nuw nsw i64 %139, 1
  %151 = icmp eq i64 %150, %46
  br i1 %151, label %152, label %138

152:
  %153 = phi double [ 0.000000e+00, %134 ], [ %149, %138 ]
  %154 = getelementptr inbounds double, ptr %23, i64 %135
  store double %153, ptr %154, align 8
  %155 = add nuw nsw i64 %135, 1
  %156 = icmp eq i64 %155, %52
  br i1 %156, label %157, label %134

157:
  br i1 %47, label %158, label %160

158:
  %159 = phi double [ 0.000000e+00, %157 ], [ %166, %160 ]
  br i1 %53, label %169, label %178

160:
  %161 = phi i64 [ %167, %160 ], [ 0, %157 ]
  %162 = phi double [ %166, %160 ], [ 0.000000e+00, %157 ]
  %163 = getelementptr inbounds [17 x double], ptr %11, i64 0, i64 %161
  %164 = load double, ptr %163, align 8
  %165 = fcmp contract ogt double %164, %162
  %166 = select i1 %165, double %164, double %162
  %167 = add nuw i64 %161, 1
  %168 = icmp eq i64 %161, %46
  br i1 %168, label %158, label %160

169:
  %170 = phi i64 [ %176, %169 ], [ 0, %158 ]
  %171 = phi double [ %175, %169 ], [ %159, %158 ]
  %172 = getelementptr inbounds [136 x double], ptr %18, i64 0, i64 %170
  %173 = load double, ptr %172, align 8
  %174 = fcmp contract ogt double %173, %171
  %175 = select i1 %174, double %173, double %171
  %176 = add nuw nsw i64 %170, 1
  %177 = icmp eq i64 %176, %52
  br i1 %177, label %178, label %169

178:
  %179 = phi double [ %159, %158 ], [ %175, %169 ]
  call void @llvm.lifetime.start.p0(i64 65536, ptr nonnull %12)
  br label %196

180:
  call void @llvm.lifetime.start.p0(i64 13056, ptr nonnull %13)
  %181 = icmp sgt i64 %46, 0
  %182 = load ptr, ptr %25, align 8
  %183 = load ptr, ptr %26, align 8
  %184 = load i64, ptr %27, align 8
  %185 = icmp sgt i64 %184, 0
  %186 = load ptr, ptr %28, align 8
  %187 = load ptr, ptr %29, align 8
  %188 = load ptr, ptr %30, align 8
  %189 = load ptr, ptr %31, align 8
  %190 = load ptr, ptr %32, align 8
  %191 = load ptr, ptr %33, align 8
  %192 = load ptr, ptr %34, align 8
  %193 = load ptr, ptr %36, align 8
  %194 = load ptr, ptr %37, align 8
  %195 = load ptr, ptr %38, align 8
  br label %206

196:
  %197 = phi i64 [ 0, %178 ], [ %202, %196 ]
  %198 = uitofp nneg i64 %197 to double
  %199 = fmul contract double %198, 2.000000e+00
  %200 = fadd contract double %199, 1.000000e+00
  %201 = fmul contract double %200, 6.250000e-02
  %202 = add nuw nsw i64 %197, 1
  %203 = getelementptr inbounds [4096 x %struct.Piece], ptr %12, i64 0, i64 %197
  store double %201, ptr %203, align 16
  %204 = getelementptr inbounds i8, ptr %203, i64 8
  store double 6.250000e-02, ptr %204, align 8
  %205 = icmp eq i64 %202, 8
  br i1 %205, label %180, label %196

206:
  %207 = phi i64 [ 8, %180 ], [ %1334, %1333 ]
  %208 = phi <8 x double> [ undef, %180 ], [ %1297, %1333 ]
  %209 = phi <8 x double> [ undef, %180 ], [ %1300, %1333 ]
  call void @llvm.lifetime.start.p0(i64 128, ptr nonnull %14)
  br label %1286

210:
  %211 = fmul contract <8 x double> %1297, zeroinitializer
  br label %212

212:
  %213 = phi i64 [ 0, %210 ], [ %221, %212 ]
  %214 = and i64 %213, 3
  %215 = icmp eq i64 %214, 0
  %216 = uitofp i1 %215 to double
  %217 = insertelement <8 x double> poison, double %216, i64 0
  %218 = shufflevector <8 x double> %217, <8 x double> poison, <8 x i32> zeroinitializer
  %219 = fadd contract <8 x double> %211, %218
  %220 = getelementptr inbounds [9 x <8 x double>], ptr %13, i64 0, i64 %213
  store <8 x double> %219, ptr %220, align 64
  %221 = add nuw nsw i64 %213, 1
  %222 = icmp eq i64 %221, 9
  br i1 %222, label %228, label %212

223:
  %224 = tail call i64 @llvm.smin.i64(i64 %207, i64 8)
  %225 = sub nsw i64 %207, %224
  br i1 %181, label %233, label %226

226:
  %227 = fmul contract <8 x double> %1300, zeroinitializer
  br label %773

228:
  %229 = phi i64 [ %231, %228 ], [ 0, %212 ]
  %230 = getelementptr inbounds [3 x <8 x double>], ptr %24, i64 0, i64 %229
  store <8 x double> %211, ptr %230, align 64
  %231 = add nuw nsw i64 %229, 1
  %232 = icmp eq i64 %231, 3
  br i1 %232, label %223, label %228

233:
  %234 = phi i64 [ %290, %443 ], [ 0, %223 ]
  %235 = getelementptr inbounds %struct.Joint.3, ptr %182, i64 %234
  %236 = getelementptr inbounds %struct.Frame.2, ptr %13, i64 %234
  %237 = getelementptr inbounds double, ptr %43, i64 %234
  %238 = load double, ptr %237, align 8
  %239 = getelementptr inbounds double, ptr %44, i64 %234
  %240 = load double, ptr %239, align 8
  %241 = insertelement <8 x double> poison, double %240, i64 0
  %242 = shufflevector <8 x double> %241, <8 x double> poison, <8 x i32> zeroinitializer
  %243 = getelementptr inbounds i8, ptr %235, i64 72
  %244 = load double, ptr %243, align 8
  %245 = getelementptr inbounds i8, ptr %235, i64 80
  %246 = load double, ptr %245, align 8
  %247 = getelementptr inbounds i8, ptr %235, i64 88
  %248 = load double, ptr %247, align 8
  %249 = getelementptr inbounds i8, ptr %236, i64 576
  %250 = load <8 x double>, ptr %249, align 64
  %251 = load <8 x double>, ptr %236, align 64
  %252 = insertelement <8 x double> poison, double %244, i64 0
  %253 = shufflevector <8 x double> %252, <8 x double> poison, <8 x i32> zeroinitializer
  %254 = getelementptr inbounds i8, ptr %236, i64 64
  %255 = load <8 x double>, ptr %254, align 64
  %256 = insertelement <8 x double> poison, double %246, i64 0
  %257 = shufflevector <8 x double> %256, <8 x double> poison, <8 x i32> zeroinitializer
  %258 = getelementptr inbounds i8, ptr %236, i64 128
  %259 = load <8 x double>, ptr %258, align 64
  %260 = insertelement <8 x double> poison, double %248, i64 0
  %261 = shufflevector <8 x double> %260, <8 x double> poison, <8 x i32> zeroinitializer
  %262 = getelementptr inbounds i8, ptr %236, i64 640
  %263 = load <8 x double>, ptr %262, align 64
  %264 = getelementptr inbounds i8, ptr %236, i64 192
  %265 = load <8 x double>, ptr %264, align 64
  %266 = getelementptr inbounds i8, ptr %236, i64 256
  %267 = load <8 x double>, ptr %266, align 64
  %268 = getelementptr inbounds i8, ptr %236, i64 320
  %269 = load <8 x double>, ptr %268, align 64
  %270 = getelementptr inbounds i8, ptr %236, i64 704
  %271 = load <8 x double>, ptr %270, align 64
  %272 = getelementptr inbounds i8, ptr %236, i64 384
  %273 = load <8 x double>, ptr %272, align 64
  %274 = getelementptr inbounds i8, ptr %236, i64 448
  %275 = load <8 x double>, ptr %274, align 64
  %276 = getelementptr inbounds i8, ptr %236, i64 512
  %277 = load <8 x double>, ptr %276, align 64
  call void @llvm.lifetime.start.p0(i64 576, ptr nonnull %10)
  br label %278

278:
  %279 = phi i64 [ 0, %233 ], [ %321, %320 ]
  %280 = mul nuw nsw i64 %279, 3
  %281 = getelementptr inbounds [9 x <8 x double>], ptr %236, i64 0, i64 %280
  %282 = load <8 x double>, ptr %281, align 64
  %283 = add nuw nsw i64 %280, 1
  %284 = getelementptr inbounds [9 x <8 x double>], ptr %236, i64 0, i64 %283
  %285 = load <8 x double>, ptr %284, align 64
  %286 = add nuw nsw i64 %280, 2
  %287 = getelementptr inbounds [9 x <8 x double>], ptr %236, i64 0, i64 %286
  %288 = load <8 x double>, ptr %287, align 64
  br label %323

289:
  %290 = add nuw nsw i64 %234, 1
  %291 = insertelement <8 x double> poison, double %238, i64 0
  %292 = fmul contract <8 x double> %1297, %242
  %293 = fmul contract <8 x double> %253, %251
  %294 = fmul contract <8 x double> %257, %255
  %295 = fmul contract <8 x double> %261, %259
  %296 = fmul contract <8 x double> %253, %265
  %297 = fmul contract <8 x double> %257, %267
  %298 = fmul contract <8 x double> %261, %269
  %299 = fmul contract <8 x double> %253, %273
  %300 = fmul contract <8 x double> %257, %275
  %301 = fmul contract <8 x double> %261, %277
  %302 = getelementptr inbounds %struct.Frame.2, ptr %13, i64 %290
  %303 = shufflevector <8 x double> %291, <8 x double> poison, <8 x i32> zeroinitializer
  %304 = fadd contract <8 x double> %303, %292
  %305 = fadd contract <8 x double> %250, %293
  %306 = fadd contract <8 x double> %305, %294
  %307 = fadd contract <8 x double> %306, %295
  %308 = fadd contract <8 x double> %263, %296
  %309 = fadd contract <8 x double> %308, %297
  %310 = fadd contract <8 x double> %309, %298
  %311 = fadd contract <8 x double> %271, %299
  %312 = fadd contract <8 x double> %311, %300
  %313 = fadd contract <8 x double> %312, %301
  %314 = getelementptr inbounds i8, ptr %302, i64 576
  store <8 x double> %307, ptr %314, align 64
  %315 = getelementptr inbounds i8, ptr %302, i64 640
  store <8 x double> %310, ptr %315, align 64
  %316 = getelementptr inbounds i8, ptr %302, i64 704
  store <8 x double> %313, ptr %316, align 64
  %317 = getelementptr inbounds i8, ptr %235, i64 96
  %318 = load double, ptr %317, align 8
  %319 = fcmp contract une double %318, 0.000000e+00
  br i1 %319, label %348, label %367

320:
  %321 = add nuw nsw i64 %279, 1
  %322 = icmp eq i64 %321, 3
  br i1 %322, label %289, label %278

323:
  %324 = phi i64 [ 0, %278 ], [ %346, %323 ]
  %325 = getelementptr inbounds [9 x double], ptr %235, i64 0, i64 %324
  %326 = load double, ptr %325, align 8
  %327 = insertelement <8 x double> poison, double %326, i64 0
  %328 = shufflevector <8 x double> %327, <8 x double> poison, <8 x i32> zeroinitializer
  %329 = fmul contract <8 x double> %282, %328
  %330 = add nuw nsw i64 %324, 3
  %331 = getelementptr inbounds [9 x double], ptr %235, i64 0, i64 %330
  %332 = load double, ptr %331, align 8
  %333 = insertelement <8 x double> poison, double %332, i64 0
  %334 = shufflevector <8 x double> %333, <8 x double> poison, <8 x i32> zeroinitializer
  %335 = fmul contract <8 x double> %285, %334
  %336 = fadd contract <8 x double> %329, %335
  %337 = add nuw nsw i64 %324, 6
  %338 = getelementptr inbounds [9 x double], ptr %235, i64 0, i64 %337
  %339 = load double, ptr %338, align 8
  %340 = insertelement <8 x double> poison, double %339, i64 0
  %341 = shufflevector <8 x double> %340, <8 x double> poison, <8 x i32> zeroinitializer
  %342 = fmul contract <8 x double> %288, %341
  %343 = fadd contract <8 x double> %336, %342
  %344 = add nuw nsw i64 %324, %280
  %345 = getelementptr inbounds [9 x <8 x double>], ptr %10, i64 0, i64 %344
  store <8 x double> %343, ptr %345, align 64
  %346 = add nuw nsw i64 %324, 1
  %347 = icmp eq i64 %346, 3
  br i1 %347, label %320, label %323

348:
  %349 = phi i64 [ %353, %348 ], [ 0, %289 ]
  %350 = getelementptr inbounds [9 x <8 x double>], ptr %10, i64 0, i64 %349
  %351 = load <8 x double>, ptr %350, align 64
  %352 = getelementptr inbounds [9 x <8 x double>], ptr %302, i64 0, i64 %349
  store <8 x double> %351, ptr %352, align 64
  %353 = add nuw nsw i64 %349, 1
  %354 = icmp eq i64 %353, 9
  br i1 %354, label %355, label %348

355:
  %356 = phi i64 [ %365, %355 ], [ 0, %348 ]
  %357 = mul nuw nsw i64 %356, 3
  %358 = add nuw nsw i64 %357, 2
  %359 = getelementptr inbounds [9 x <8 x double>], ptr %10, i64 0, i64 %358
  %360 = load <8 x double>, ptr %359, align 64
  %361 = fmul contract <8 x double> %304, %360
  %362 = getelementptr inbounds [3 x <8 x double>], ptr %314, i64 0, i64 %356
  %363 = load <8 x double>, ptr %362, align 64
  %364 = fadd contract <8 x double> %363, %361
  store <8 x double> %364, ptr %362, align 64
  %365 = add nuw nsw i64 %356, 1
  %366 = icmp eq i64 %365, 3
  br i1 %366, label %443, label %355

367:
  %368 = fmul contract <8 x double> %304, <double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883>
  %369 = fadd contract <8 x double> %368, <double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000>
  %370 = fadd contract <8 x double> %369, <double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000>
  %371 = fmul contract <8 x double> %370, <double 0x400921FB54400000, double 0x400921FB54400000, double 0x400921FB54400000, double 0x400921FB54400000, double 0x400921FB54400000, double 0x400921FB54400000, double 0x400921FB54400000, double 0x400921FB54400000>
  %372 = fsub contract <8 x double> %304, %371
  %373 = fmul contract <8 x double> %370, <double 0x3DE0B4611A600000, double 0x3DE0B4611A600000, double 0x3DE0B4611A600000, double 0x3DE0B4611A600000, double 0x3DE0B4611A600000, double 0x3DE0B4611A600000, double 0x3DE0B4611A600000, double 0x3DE0B4611A600000>
  %374 = fsub contract <8 x double> %372, %373
  %375 = fmul contract <8 x double> %370, <double 0x3BB3198A2E071925, double 0x3BB3198A2E071925, double 0x3BB3198A2E071925, double 0x3BB3198A2E071925, double 0x3BB3198A2E071925, double 0x3BB3198A2E071925, double 0x3BB3198A2E071925, double 0x3BB3198A2E071925>
  %376 = fsub contract <8 x double> %374, %375
  %377 = fmul contract <8 x double> %370, <double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01>
  %378 = fadd contract <8 x double> %377, <double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000>
  %379 = fadd contract <8 x double> %378, <double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000>
  %380 = fsub contract <8 x double> %377, %379
  %381 = tail call contract <8 x double> @llvm.fabs.v8f64(<8 x double> %380)
  %382 = fmul contract <8 x double> %381, <double 4.000000e+00, double 4.000000e+00, double 4.000000e+00, double 4.000000e+00, double 4.000000e+00, double 4.000000e+00, double 4.000000e+00, double 4.000000e+00>
  %383 = fsub contract <8 x double> <double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00>, %382
  %384 = fmul contract <8 x double> %376, <double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01>
  %385 = fmul contract <8 x double> %384, %384
  %386 = fmul contract <8 x double> %384, %385
  %387 = fmul contract <8 x double> %385, <double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C>
  %388 = fadd contract <8 x double> %387, <double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB>
  %389 = fmul contract <8 x double> %385, %388
  %390 = fadd contract <8 x double> %389, <double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D>
  %391 = fmul contract <8 x double> %385, %390
  %392 = fadd contract <8 x double> %391, <double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5>
  %393 = fmul contract <8 x double> %385, %392
  %394 = fadd contract <8 x double> %393, <double 0x3F8111111110F8A6, double 0x3F8111111110F8A6, double 0x3F8111111110F8A6, double 0x3F8111111110F8A6, double 0x3F8111111110F8A6, double 0x3F8111111110F8A6, double 0x3F8111111110F8A6, double 0x3F8111111110F8A6>
  %395 = fmul contract <8 x double> %385, %394
  %396 = fadd contract <8 x double> %395, <double 0xBFC5555555555549, double 0xBFC5555555555549, double 0xBFC5555555555549, double 0xBFC5555555555549, double 0xBFC5555555555549, double 0xBFC5555555555549, double 0xBFC5555555555549, double 0xBFC5555555555549>
  %397 = fmul contract <8 x double> %386, %396
  %398 = fadd contract <8 x double> %384, %397
  %399 = fmul contract <8 x double> %385, <double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01>
  %400 = fsub contract <8 x double> <double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00>, %399
  %401 = fmul contract <8 x double> %385, %385
  %402 = fmul contract <8 x double> %385, <double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4>
  %403 = fsub contract <8 x double> <double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4>, %402
  %404 = fmul contract <8 x double> %385, %403
  %405 = fadd contract <8 x double> %404, <double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD>
  %406 = fmul contract <8 x double> %385, %405
  %407 = fadd contract <8 x double> %406, <double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590>
  %408 = fmul contract <8 x double> %385, %407
  %409 = fadd contract <8 x double> %408, <double 0xBF56C16C16C15177, double 0xBF56C16C16C15177, double 0xBF56C16C16C15177, double 0xBF56C16C16C15177, double 0xBF56C16C16C15177, double 0xBF56C16C16C15177, double 0xBF56C16C16C15177, double 0xBF56C16C16C15177>
  %410 = fmul contract <8 x double> %385, %409
  %411 = fadd contract <8 x double> %410, <double 0x3FA555555555554C, double 0x3FA555555555554C, double 0x3FA555555555554C, double 0x3FA555555555554C, double 0x3FA555555555554C, double 0x3FA555555555554C, double 0x3FA555555555554C, double 0x3FA555555555554C>
  %412 = fmul contract <8 x double> %401, %411
  %413 = fadd contract <8 x double> %400, %412
  %414 = fmul contract <8 x double> %383, <double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00>
  %415 = fmul contract <8 x double> %414, %398
  %416 = fmul contract <8 x double> %413, %415
  %417 = fmul contract <8 x double> %398, <double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00>
  %418 = fmul contract <8 x double> %398, %417
  %419 = fsub contract <8 x double> <double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00>, %418
  %420 = fmul contract <8 x double> %383, %419
  br label %421

421:
  %422 = phi i64 [ 0, %367 ], [ %441, %421 ]
  %423 = mul nuw nsw i64 %422, 3
  %424 = getelementptr inbounds [9 x <8 x double>], ptr %10, i64 0, i64 %423
  %425 = load <8 x double>, ptr %424, align 64
  %426 = fmul contract <8 x double> %420, %425
  %427 = add nuw nsw i64 %423, 1
  %428 = getelementptr inbounds [9 x <8 x double>], ptr %10, i64 0, i64 %427
  %429 = load <8 x double>, ptr %428, align 64
  %430 = fmul contract <8 x double> %416, %429
  %431 = fadd contract <8 x double> %426, %430
  %432 = getelementptr inbounds [9 x <8 x double>], ptr %302, i64 0, i64 %423
  store <8 x double> %431, ptr %432, align 64
  %433 = fmul contract <8 x double> %420, %429
  %434 = fmul contract <8 x double> %416, %425
  %435 = fsub contract <8 x double> %433, %434
  %436 = getelementptr inbounds [9 x <8 x double>], ptr %302, i64 0, i64 %427
  store <8 x double> %435, ptr %436, align 64
  %437 = add nuw nsw i64 %423, 2
  %438 = getelementptr inbounds [9 x <8 x double>], ptr %10, i64 0, i64 %437
  %439 = load <8 x double>, ptr %438, align 64
  %440 = getelementptr inbounds [9 x <8 x double>], ptr %302, i64 0, i64 %437
  store <8 x double> %439, ptr %440, align 64
  %441 = add nuw nsw i64 %422, 1
  %442 = icmp eq i64 %441, 3
  br i1 %442, label %443, label %421

443:
  call void @llvm.lifetime.end.p0(i64 576, ptr nonnull %10)
  %444 = icmp eq i64 %290, %46
  br i1 %444, label %445, label %233

445:
  %446 = fmul contract <8 x double> %1300, zeroinitializer
  br label %447

447:
  %448 = phi <8 x i64> [ %770, %769 ], [ zeroinitializer, %445 ]
  %449 = phi i64 [ %771, %769 ], [ 1, %445 ]
  %450 = getelementptr inbounds %struct.Sphere.5, ptr %183, i64 %449
  %451 = getelementptr inbounds i8, ptr %450, i64 24
  %452 = load double, ptr %451, align 8
  %453 = fcmp contract olt double %452, 0.000000e+00
  br i1 %453, label %769, label %454

454:
  %455 = getelementptr inbounds %struct.Frame.2, ptr %13, i64 %449
  %456 = load double, ptr %450, align 8
  %457 = getelementptr inbounds i8, ptr %450, i64 8
  %458 = load double, ptr %457, align 8
  %459 = getelementptr inbounds i8, ptr %450, i64 16
  %460 = load double, ptr %459, align 8
  %461 = getelementptr inbounds i8, ptr %455, i64 576
  %462 = load <8 x double>, ptr %461, align 64
  %463 = load <8 x double>, ptr %455, align 64
  %464 = insertelement <8 x double> poison, double %456, i64 0
  %465 = shufflevector <8 x double> %464, <8 x double> poison, <8 x i32> zeroinitializer
  %466 = fmul contract <8 x double> %465, %463
  %467 = fadd contract <8 x double> %462, %466
  %468 = getelementptr inbounds i8, ptr %455, i64 64
  %469 = load <8 x double>, ptr %468, align 64
  %470 = insertelement <8 x double> poison, double %458, i64 0
  %471 = shufflevector <8 x double> %470, <8 x double> poison, <8 x i32> zeroinitializer
  %472 = fmul contract <8 x double> %471, %469
  %473 = fadd contract <8 x double> %467, %472
  %474 = getelementptr inbounds i8, ptr %455, i64 128
  %475 = load <8 x double>, ptr %474, align 64
  %476 = insertelement <8 x double> poison, double %460, i64 0
  %477 = shufflevector <8 x double> %476, <8 x double> poison, <8 x i32> zeroinitializer
  %478 = fmul contract <8 x double> %477, %475
  %479 = fadd contract <8 x double> %473, %478
  %480 = getelementptr inbounds i8, ptr %455, i64 640
  %481 = load <8 x double>, ptr %480, align 64
  %482 = getelementptr inbounds i8, ptr %455, i64 192
  %483 = load <8 x double>, ptr %482, align 64
  %484 = fmul contract <8 x double> %465, %483
  %485 = fadd contract <8 x double> %481, %484
  %486 = getelementptr inbounds i8, ptr %455, i64 256
  %487 = load <8 x double>, ptr %486, align 64
  %488 = fmul contract <8 x double> %471, %487
  %489 = fadd contract <8 x double> %485, %488
  %490 = getelementptr inbounds i8, ptr %455, i64 320
  %491 = load <8 x double>, ptr %490, align 64
  %492 = fmul contract <8 x double> %477, %491
  %493 = fadd contract <8 x double> %489, %492
  %494 = getelementptr inbounds i8, ptr %455, i64 704
  %495 = load <8 x double>, ptr %494, align 64
  %496 = getelementptr inbounds i8, ptr %455, i64 384
  %497 = load <8 x double>, ptr %496, align 64
  %498 = fmul contract <8 x double> %465, %497
  %499 = fadd contract <8 x double> %495, %498
  %500 = getelementptr inbounds i8, ptr %455, i64 448
  %501 = load <8 x double>, ptr %500, align 64
  %502 = fmul contract <8 x double> %471, %501
  %503 = fadd contract <8 x double> %499, %502
  %504 = getelementptr inbounds i8, ptr %455, i64 512
  %505 = load <8 x double>, ptr %504, align 64
  %506 = fmul contract <8 x double> %477, %505
  %507 = fadd contract <8 x double> %503, %506
  %508 = getelementptr inbounds [17 x double], ptr %11, i64 0, i64 %449
  %509 = load double, ptr %508, align 8
  %510 = insertelement <8 x double> poison, double %509, i64 0
  %511 = shufflevector <8 x double> %510, <8 x double> poison, <8 x i32> zeroinitializer
  %512 = fmul contract <8 x double> %1300, %511
  %513 = getelementptr inbounds [17 x double], ptr %22, i64 0, i64 %449
  %514 = load double, ptr %513, align 8
  %515 = insertelement <8 x double> poison, double %514, i64 0
  %516 = shufflevector <8 x double> %515, <8 x double> poison, <8 x i32> zeroinitializer
  %517 = fadd contract <8 x double> %512, %516
  br i1 %185, label %518, label %769

518:
  %519 = mul nuw nsw i64 %449, %184
  %520 = getelementptr double, ptr %187, i64 %519
  %521 = getelementptr inbounds i64, ptr %188, i64 %449
  %522 = getelementptr inbounds i8, ptr %521, i64 8
  br label %523

523:
  %524 = phi <8 x i64> [ %448, %518 ], [ %766, %765 ]
  %525 = phi i64 [ 0, %518 ], [ %767, %765 ]
  %526 = getelementptr inbounds %struct.Object.6, ptr %186, i64 %525
  %527 = getelementptr double, ptr %520, i64 %525
  %528 = load double, ptr %527, align 8
  %529 = getelementptr inbounds i8, ptr %526, i64 120
  %530 = load double, ptr %529, align 8
  %531 = fadd contract double %528, %530
  %532 = fcmp contract olt double %531, -1.000000e+08
  br i1 %532, label %765, label %533

533:
  %534 = fadd contract double %452, %531
  %535 = insertelement <8 x double> poison, double %534, i64 0
  %536 = shufflevector <8 x double> %535, <8 x double> poison, <8 x i32> zeroinitializer
  %537 = fadd contract <8 x double> %517, %536
  %538 = fcmp contract ogt <8 x double> %537, %446
  %539 = select contract <8 x i1> %538, <8 x double> %537, <8 x double> %446
  %540 = getelementptr inbounds i8, ptr %526, i64 72
  %541 = load double, ptr %540, align 8
  %542 = insertelement <8 x double> poison, double %541, i64 0
  %543 = shufflevector <8 x double> %542, <8 x double> poison, <8 x i32> zeroinitializer
  %544 = load double, ptr %526, align 8
  %545 = insertelement <8 x double> poison, double %544, i64 0
  %546 = shufflevector <8 x double> %545, <8 x double> poison, <8 x i32> zeroinitializer
  %547 = fmul contract <8 x double> %479, %546
  %548 = fadd contract <8 x double> %543, %547
  %549 = getelementptr inbounds i8, ptr %526, i64 8
  %550 = load double, ptr %549, align 8
  %551 = insertelement <8 x double> poison, double %550, i64 0
  %552 = shufflevector <8 x double> %551, <8 x double> poison, <8 x i32> zeroinitializer
  %553 = fmul contract <8 x double> %493, %552
  %554 = fadd contract <8 x double> %548, %553
  %555 = getelementptr inbounds i8, ptr %526, i64 16
  %556 = load double, ptr %555, align 8
  %557 = insertelement <8 x double> poison, double %556, i64 0
  %558 = shufflevector <8 x double> %557, <8 x double> poison, <8 x i32> zeroinitializer
  %559 = fmul contract <8 x double> %507, %558
  %560 = fadd contract <8 x double> %554, %559
  %561 = getelementptr inbounds i8, ptr %526, i64 80
  %562 = load double, ptr %561, align 8
  %563 = insertelement <8 x double> poison, double %562, i64 0
  %564 = shufflevector <8 x double> %563, <8 x double> poison, <8 x i32> zeroinitializer
  %565 = getelementptr inbounds i8, ptr %526, i64 24
  %566 = load double, ptr %565, align 8
  %567 = insertelement <8 x double> poison, double %566, i64 0
  %568 = shufflevector <8 x double> %567, <8 x double> poison, <8 x i32> zeroinitializer
  %569 = fmul contract <8 x double> %479, %568
  %570 = fadd contract <8 x double> %564, %569
  %571 = getelementptr inbounds i8, ptr %526, i64 32
  %572 = load double, ptr %571, align 8
  %573 = insertelement <8 x double> poison, double %572, i64 0
  %574 = shufflevector <8 x double> %573, <8 x double> poison, <8 x i32> zeroinitializer
  %575 = fmul contract <8 x double> %493, %574
  %576 = fadd contract <8 x double> %570, %575
  %577 = getelementptr inbounds i8, ptr %526, i64 40
  %578 = load double, ptr %577, align 8
  %579 = insertelement <8 x double> poison, double %578, i64 0
  %580 = shufflevector <8 x double> %579, <8 x double> poison, <8 x i32> zeroinitializer
  %581 = fmul contract <8 x double> %507, %580
  %582 = fadd contract <8 x double> %576, %581
  %583 = getelementptr inbounds i8, ptr %526, i64 88
  %584 = load double, ptr %583, align 8
  %585 = insertelement <8 x double> poison, double %584, i64 0
  %586 = shufflevector <8 x double> %585, <8 x double> poison, <8 x i32> zeroinitializer
  %587 = getelementptr inbounds i8, ptr %526, i64 48
  %588 = load double, ptr %587, align 8
  %589 = insertelement <8 x double> poison, double %588, i64 0
  %590 = shufflevector <8 x double> %589, <8 x double> poison, <8 x i32> zeroinitializer
  %591 = fmul contract <8 x double> %479, %590
  %592 = fadd contract <8 x double> %586, %591
  %593 = getelementptr inbounds i8, ptr %526, i64 56
  %594 = load double, ptr %593, align 8
  %595 = insertelement <8 x double> poison, double %594, i64 0
  %596 = shufflevector <8 x double> %595, <8 x double> poison, <8 x i32> zeroinitializer
  %597 = fmul contract <8 x double> %493, %596
  %598 = fadd contract <8 x double> %592, %597
  %599 = getelementptr inbounds i8, ptr %526, i64 64
  %600 = load double, ptr %599, align 8
  %601 = insertelement <8 x double> poison, double %600, i64 0
  %602 = shufflevector <8 x double> %601, <8 x double> poison, <8 x i32> zeroinitializer
  %603 = fmul contract <8 x double> %507, %602
  %604 = fadd contract <8 x double> %598, %603
  %605 = fmul contract <8 x double> %560, zeroinitializer
  %606 = getelementptr inbounds i8, ptr %526, i64 136
  %607 = load double, ptr %606, align 8
  %608 = fcmp contract une double %607, 0.000000e+00
  %609 = tail call contract <8 x double> @llvm.fabs.v8f64(<8 x double> %604)
  %610 = select contract i1 %608, <8 x double> %604, <8 x double> %609
  %611 = getelementptr inbounds i8, ptr %526, i64 128
  %612 = load double, ptr %611, align 8
  %613 = fcmp contract une double %612, 0.000000e+00
  br i1 %613, label %614, label %619

614:
  %615 = fmul contract <8 x double> %560, %560
  %616 = fmul contract <8 x double> %582, %582
  %617 = fadd contract <8 x double> %615, %616
  %618 = tail call contract noundef <8 x double> @llvm.sqrt.v8f64(<8 x double> %617)
  br label %621

619:
  %620 = tail call contract <8 x double> @llvm.fabs.v8f64(<8 x double> %560)
  br label %621

621:
  %622 = phi contract <8 x double> [ %618, %614 ], [ %620, %619 ]
  %623 = getelementptr inbounds i8, ptr %526, i64 96
  %624 = load double, ptr %623, align 8
  %625 = insertelement <8 x double> poison, double %624, i64 0
  %626 = shufflevector <8 x double> %625, <8 x double> poison, <8 x i32> zeroinitializer
  %627 = fsub contract <8 x double> %622, %626
  %628 = fcmp contract ogt <8 x double> %627, %605
  %629 = select contract <8 x i1> %628, <8 x double> %627, <8 x double> %605
  %630 = getelementptr inbounds i8, ptr %526, i64 112
  %631 = load double, ptr %630, align 8
  %632 = insertelement <8 x double> poison, double %631, i64 0
  %633 = shufflevector <8 x double> %632, <8 x double> poison, <8 x i32> zeroinitializer
  %634 = fsub contract <8 x double> %610, %633
  %635 = fcmp contract ogt <8 x double> %634, %605
  %636 = select contract <8 x i1> %635, <8 x double> %634, <8 x double> %605
  %637 = fmul contract <8 x double> %629, %629
  %638 = fmul contract <8 x double> %636, %636
  %639 = fadd contract <8 x double> %637, %638
  br i1 %613, label %651, label %640

640:
  %641 = tail call contract <8 x double> @llvm.fabs.v8f64(<8 x double> %582)
  %642 = getelementptr inbounds i8, ptr %526, i64 104
  %643 = load double, ptr %642, align 8
  %644 = insertelement <8 x double> poison, double %643, i64 0
  %645 = shufflevector <8 x double> %644, <8 x double> poison, <8 x i32> zeroinitializer
  %646 = fsub contract <8 x double> %641, %645
  %647 = fcmp contract ogt <8 x double> %646, %605
  %648 = select contract <8 x i1> %647, <8 x double> %646, <8 x double> %605
  %649 = fmul contract <8 x double> %648, %648
  %650 = fadd contract <8 x double> %639, %649
  br label %651

651:
  %652 = phi <8 x double> [ %650, %640 ], [ %639, %621 ]
  %653 = fmul contract <8 x double> %539, %539
  %654 = fcmp contract olt <8 x double> %652, %653
  %655 = bitcast <8 x i1> %654 to i8
  %656 = icmp eq i8 %655, 0
  br i1 %656, label %765, label %657

657:
  %658 = load i64, ptr %521, align 8
  %659 = load i64, ptr %522, align 8
  %660 = icmp slt i64 %658, %659
  br i1 %660, label %661, label %663

661:
  %662 = getelementptr inbounds i8, ptr %526, i64 104
  br label %668

663:
  %664 = phi <8 x i64> [ %524, %657 ], [ %762, %758 ]
  %665 = icmp eq <8 x i64> %664, zeroinitializer
  %666 = bitcast <8 x i1> %665 to i8
  %667 = icmp eq i8 %666, 0
  br i1 %667, label %1283, label %765

668:
  %669 = phi <8 x i64> [ %524, %661 ], [ %762, %758 ]
  %670 = phi i64 [ %658, %661 ], [ %763, %758 ]
  %671 = getelementptr inbounds %struct.Sphere.5, ptr %189, i64 %670
  %672 = getelementptr inbounds i8, ptr %671, i64 24
  %673 = load double, ptr %672, align 8
  %674 = fadd contract double %531, %673
  %675 = insertelement <8 x double> poison, double %674, i64 0
  %676 = shufflevector <8 x double> %675, <8 x double> poison, <8 x i32> zeroinitializer
  %677 = fadd contract <8 x double> %517, %676
  %678 = fcmp contract ogt <8 x double> %677, %446
  %679 = select contract <8 x i1> %678, <8 x double> %677, <8 x double> %446
  %680 = load double, ptr %671, align 8
  %681 = getelementptr inbounds i8, ptr %671, i64 8
  %682 = load double, ptr %681, align 8
  %683 = getelementptr inbounds i8, ptr %671, i64 16
  %684 = load double, ptr %683, align 8
  %685 = insertelement <8 x double> poison, double %680, i64 0
  %686 = shufflevector <8 x double> %685, <8 x double> poison, <8 x i32> zeroinitializer
  %687 = fmul contract <8 x double> %463, %686
  %688 = fadd contract <8 x double> %462, %687
  %689 = insertelement <8 x double> poison, double %682, i64 0
  %690 = shufflevector <8 x double> %689, <8 x double> poison, <8 x i32> zeroinitializer
  %691 = fmul contract <8 x double> %469, %690
  %692 = fadd contract <8 x double> %688, %691
  %693 = insertelement <8 x double> poison, double %684, i64 0
  %694 = shufflevector <8 x double> %693, <8 x double> poison, <8 x i32> zeroinitializer
  %695 = fmul contract <8 x double> %475, %694
  %696 = fadd contract <8 x double> %692, %695
  %697 = fmul contract <8 x double> %483, %686
  %698 = fadd contract <8 x double> %481, %697
  %699 = fmul contract <8 x double> %487, %690
  %700 = fadd contract <8 x double> %698, %699
  %701 = fmul contract <8 x double> %491, %694
  %702 = fadd contract <8 x double> %700, %701
  %703 = fmul contract <8 x double> %497, %686
  %704 = fadd contract <8 x double> %495, %703
  %705 = fmul contract <8 x double> %501, %690
  %706 = fadd contract <8 x double> %704, %705
  %707 = fmul contract <8 x double> %505, %694
  %708 = fadd contract <8 x double> %706, %707
  %709 = fmul contract <8 x double> %546, %696
  %710 = fadd contract <8 x double> %543, %709
  %711 = fmul contract <8 x double> %552, %702
  %712 = fadd contract <8 x double> %711, %710
  %713 = fmul contract <8 x double> %558, %708
  %714 = fadd contract <8 x double> %713, %712
  %715 = fmul contract <8 x double> %568, %696
  %716 = fadd contract <8 x double> %564, %715
  %717 = fmul contract <8 x double> %574, %702
  %718 = fadd contract <8 x double> %717, %716
  %719 = fmul contract <8 x double> %580, %708
  %720 = fadd contract <8 x double> %719, %718
  %721 = fmul contract <8 x double> %590, %696
  %722 = fadd contract <8 x double> %586, %721
  %723 = fmul contract <8 x double> %596, %702
  %724 = fadd contract <8 x double> %723, %722
  %725 = fmul contract <8 x double> %602, %708
  %726 = fadd contract <8 x double> %725, %724
  %727 = fmul contract <8 x double> %714, zeroinitializer
  %728 = tail call contract <8 x double> @llvm.fabs.v8f64(<8 x double> %726)
  %729 = select contract i1 %608, <8 x double> %726, <8 x double> %728
  br i1 %613, label %730, label %735

730:
  %731 = fmul contract <8 x double> %714, %714
  %732 = fmul contract <8 x double> %720, %720
  %733 = fadd contract <8 x double> %731, %732
  %734 = tail call contract noundef <8 x double> @llvm.sqrt.v8f64(<8 x double> %733)
  br label %737

735:
  %736 = tail call contract <8 x double> @llvm.fabs.v8f64(<8 x double> %714)
  br label %737

737:
  %738 = phi contract <8 x double> [ %734, %730 ], [ %736, %735 ]
  %739 = fsub contract <8 x double> %738, %626
  %740 = fcmp contract ogt <8 x double> %739, %727
  %741 = select contract <8 x i1> %740, <8 x double> %739, <8 x double> %727
  %742 = fsub contract <8 x double> %729, %633
  %743 = fcmp contract ogt <8 x double> %742, %727
  %744 = select contract <8 x i1> %743, <8 x double> %742, <8 x double> %727
  %745 = fmul contract <8 x double> %741, %741
  %746 = fmul contract <8 x double> %744, %744
  %747 = fadd contract <8 x double> %746, %745
  br i1 %613, label %758, label %748

748:
  %749 = tail call contract <8 x double> @llvm.fabs.v8f64(<8 x double> %720)
  %750 = load double, ptr %662, align 8
  %751 = insertelement <8 x double> poison, double %750, i64 0
  %752 = shufflevector <8 x double> %751, <8 x double> poison, <8 x i32> zeroinitializer
  %753 = fsub contract <8 x double> %749, %752
  %754 = fcmp contract ogt <8 x double> %753, %727
  %755 = select contract <8 x i1> %754, <8 x double> %753, <8 x double> %727
  %756 = fmul contract <8 x double> %755, %755
  %757 = fadd contract <8 x double> %747, %756
  br label %758

758:
  %759 = phi <8 x double> [ %757, %748 ], [ %747, %737 ]
  %760 = fmul contract <8 x double> %679, %679
  %761 = fcmp contract olt <8 x double> %759, %760
  %762 = select <8 x i1> %761, <8 x i64> <i64 -1, i64 -1, i64 -1, i64 -1, i64 -1, i64 -1, i64 -1, i64 -1>, <8 x i64> %669
  %763 = add nsw i64 %670, 1
  %764 = icmp eq i64 %763, %659
  br i1 %764, label %663, label %668

765:
  %766 = phi <8 x i64> [ %664, %663 ], [ %524, %651 ], [ %524, %523 ]
  %767 = add nuw nsw i64 %525, 1
  %768 = icmp eq i64 %767, %184
  br i1 %768, label %769, label %523

769:
  %770 = phi <8 x i64> [ %448, %447 ], [ %448, %454 ], [ %766, %765 ]
  %771 = add nuw i64 %449, 1
  %772 = icmp eq i64 %449, %46
  br i1 %772, label %773, label %447

773:
  %774 = phi <8 x double> [ %227, %226 ], [ %446, %769 ]
  %775 = phi <8 x i64> [ zeroinitializer, %226 ], [ %770, %769 ]
  call void @llvm.lifetime.start.p0(i64 36864, ptr nonnull %8)
  br i1 %53, label %778, label %776

776:
  %777 = phi <8 x i64> [ %775, %773 ], [ %1280, %1278 ]
  call void @llvm.lifetime.end.p0(i64 36864, ptr nonnull %8)
  br label %1283

778:
  %779 = phi <8 x i64> [ %1280, %1278 ], [ %775, %773 ]
  %780 = phi i64 [ %1279, %1278 ], [ 0, %773 ]
  %781 = phi i64 [ %1281, %1278 ], [ 0, %773 ]
  %782 = getelementptr inbounds %struct.LinkPair, ptr %190, i64 %781
  %783 = load i64, ptr %782, align 8
  %784 = getelementptr inbounds %struct.Sphere.5, ptr %191, i64 %783
  %785 = getelementptr inbounds i8, ptr %782, i64 8
  %786 = load i64, ptr %785, align 8
  %787 = getelementptr inbounds %struct.Sphere.5, ptr %191, i64 %786
  %788 = getelementptr inbounds %struct.Frame.2, ptr %13, i64 %783
  %789 = getelementptr inbounds %struct.Frame.2, ptr %13, i64 %786
  %790 = getelementptr inbounds [136 x double], ptr %18, i64 0, i64 %781
  %791 = load double, ptr %790, align 8
  %792 = insertelement <8 x double> poison, double %791, i64 0
  %793 = shufflevector <8 x double> %792, <8 x double> poison, <8 x i32> zeroinitializer
  %794 = fmul contract <8 x double> %1300, %793
  %795 = getelementptr inbounds [136 x double], ptr %23, i64 0, i64 %781
  %796 = load double, ptr %795, align 8
  %797 = getelementptr inbounds double, ptr %192, i64 %781
  %798 = load double, ptr %797, align 8
  %799 = fadd contract double %796, %798
  %800 = insertelement <8 x double> poison, double %799, i64 0
  %801 = shufflevector <8 x double> %800, <8 x double> poison, <8 x i32> zeroinitializer
  %802 = fadd contract <8 x double> %794, %801
  %803 = load double, ptr %787, align 8
  %804 = getelementptr inbounds i8, ptr %787, i64 8
  %805 = load double, ptr %804, align 8
  %806 = getelementptr inbounds i8, ptr %787, i64 16
  %807 = load double, ptr %806, align 8
  %808 = getelementptr inbounds i8, ptr %789, i64 576
  %809 = load <8 x double>, ptr %808, align 64
  %810 = load <8 x double>, ptr %789, align 64
  %811 = insertelement <8 x double> poison, double %803, i64 0
  %812 = shufflevector <8 x double> %811, <8 x double> poison, <8 x i32> zeroinitializer
  %813 = fmul contract <8 x double> %812, %810
  %814 = fadd contract <8 x double> %809, %813
  %815 = getelementptr inbounds i8, ptr %789, i64 64
  %816 = load <8 x double>, ptr %815, align 64
  %817 = insertelement <8 x double> poison, double %805, i64 0
  %818 = shufflevector <8 x double> %817, <8 x double> poison, <8 x i32> zeroinitializer
  %819 = fmul contract <8 x double> %818, %816
  %820 = fadd contract <8 x double> %814, %819
  %821 = getelementptr inbounds i8, ptr %789, i64 128
  %822 = load <8 x double>, ptr %821, align 64
  %823 = insertelement <8 x double> poison, double %807, i64 0
  %824 = shufflevector <8 x double> %823, <8 x double> poison, <8 x i32> zeroinitializer
  %825 = fmul contract <8 x double> %824, %822
  %826 = fadd contract <8 x double> %820, %825
  %827 = getelementptr inbounds i8, ptr %789, i64 640
  %828 = load <8 x double>, ptr %827, align 64
  %829 = getelementptr inbounds i8, ptr %789, i64 192
  %830 = load <8 x double>, ptr %829, align 64
  %831 = fmul contract <8 x double> %812, %830
  %832 = fadd contract <8 x double> %828, %831
  %833 = getelementptr inbounds i8, ptr %789, i64 256
  %834 = load <8 x double>, ptr %833, align 64
  %835 = fmul contract <8 x double> %818, %834
  %836 = fadd contract <8 x double> %832, %835
  %837 = getelementptr inbounds i8, ptr %789, i64 320
  %838 = load <8 x double>, ptr %837, align 64
  %839 = fmul contract <8 x double> %824, %838
  %840 = fadd contract <8 x double> %836, %839
  %841 = getelementptr inbounds i8, ptr %789, i64 704
  %842 = load <8 x double>, ptr %841, align 64
  %843 = getelementptr inbounds i8, ptr %789, i64 384
  %844 = load <8 x double>, ptr %843, align 64
  %845 = fmul contract <8 x double> %812, %844
  %846 = fadd contract <8 x double> %842, %845
  %847 = getelementptr inbounds i8, ptr %789, i64 448
  %848 = load <8 x double>, ptr %847, align 64
  %849 = fmul contract <8 x double> %818, %848
  %850 = fadd contract <8 x double> %846, %849
  %851 = getelementptr inbounds i8, ptr %789, i64 512
  %852 = load <8 x double>, ptr %851, align 64
  %853 = fmul contract <8 x double> %824, %852
  %854 = fadd contract <8 x double> %850, %853
  %855 = getelementptr inbounds i8, ptr %784, i64 24
  %856 = load double, ptr %855, align 8
  %857 = getelementptr inbounds i8, ptr %787, i64 24
  %858 = load double, ptr %857, align 8
  %859 = fadd contract double %856, %858
  %860 = insertelement <8 x double> poison, double %859, i64 0
  %861 = shufflevector <8 x double> %860, <8 x double> poison, <8 x i32> zeroinitializer
  %862 = fadd contract <8 x double> %802, %861
  %863 = fcmp contract ogt <8 x double> %862, %774
  %864 = select contract <8 x i1> %863, <8 x double> %862, <8 x double> %774
  %865 = load double, ptr %784, align 8
  %866 = getelementptr inbounds i8, ptr %784, i64 8
  %867 = load double, ptr %866, align 8
  %868 = getelementptr inbounds i8, ptr %784, i64 16
  %869 = load double, ptr %868, align 8
  %870 = getelementptr inbounds i8, ptr %788, i64 576
  %871 = load <8 x double>, ptr %870, align 64
  %872 = load <8 x double>, ptr %788, align 64
  %873 = insertelement <8 x double> poison, double %865, i64 0
  %874 = shufflevector <8 x double> %873, <8 x double> poison, <8 x i32> zeroinitializer
  %875 = fmul contract <8 x double> %874, %872
  %876 = fadd contract <8 x double> %871, %875
  %877 = getelementptr inbounds i8, ptr %788, i64 64
  %878 = load <8 x double>, ptr %877, align 64
  %879 = insertelement <8 x double> poison, double %867, i64 0
  %880 = shufflevector <8 x double> %879, <8 x double> poison, <8 x i32> zeroinitializer
  %881 = fmul contract <8 x double> %880, %878
  %882 = fadd contract <8 x double> %876, %881
  %883 = getelementptr inbounds i8, ptr %788, i64 128
  %884 = load <8 x double>, ptr %883, align 64
  %885 = insertelement <8 x double> poison, double %869, i64 0
  %886 = shufflevector <8 x double> %885, <8 x double> poison, <8 x i32> zeroinitializer
  %887 = fmul contract <8 x double> %886, %884
  %888 = fadd contract <8 x double> %882, %887
  %889 = getelementptr inbounds i8, ptr %788, i64 640
  %890 = load <8 x double>, ptr %889, align 64
  %891 = getelementptr inbounds i8, ptr %788, i64 192
  %892 = load <8 x double>, ptr %891, align 64
  %893 = fmul contract <8 x double> %874, %892
  %894 = fadd contract <8 x double> %890, %893
  %895 = getelementptr inbounds i8, ptr %788, i64 256
  %896 = load <8 x double>, ptr %895, align 64
  %897 = fmul contract <8 x double> %880, %896
  %898 = fadd contract <8 x double> %894, %897
  %899 = getelementptr inbounds i8, ptr %788, i64 320
  %900 = load <8 x double>, ptr %899, align 64
  %901 = fmul contract <8 x double> %886, %900
  %902 = fadd contract <8 x double> %898, %901
  %903 = getelementptr inbounds i8, ptr %788, i64 704
  %904 = load <8 x double>, ptr %903, align 64
  %905 = getelementptr inbounds i8, ptr %788, i64 384
  %906 = load <8 x double>, ptr %905, align 64
  %907 = fmul contract <8 x double> %874, %906
  %908 = fadd contract <8 x double> %904, %907
  %909 = getelementptr inbounds i8, ptr %788, i64 448
  %910 = load <8 x double>, ptr %909, align 64
  %911 = fmul contract <8 x double> %880, %910
  %912 = fadd contract <8 x double> %908, %911
  %913 = getelementptr inbounds i8, ptr %788, i64 512
  %914 = load <8 x double>, ptr %913, align 64
  %915 = fmul contract <8 x double> %886, %914
  %916 = fadd contract <8 x double> %912, %915
  %917 = fsub contract <8 x double> %888, %826
  %918 = fsub contract <8 x double> %902, %840
  %919 = fsub contract <8 x double> %916, %854
  %920 = fmul contract <8 x double> %917, %917
  %921 = fmul contract <8 x double> %918, %918
  %922 = fadd contract <8 x double> %920, %921
  %923 = fmul contract <8 x double> %919, %919
  %924 = fadd contract <8 x double> %922, %923
  %925 = fmul contract <8 x double> %864, %864
  %926 = fcmp contract olt <8 x double> %924, %925
  %927 = bitcast <8 x i1> %926 to i8
  %928 = icmp eq i8 %927, 0
  br i1 %928, label %1278, label %929

929:
  call void @llvm.lifetime.start.p0(i64 16, ptr nonnull %9)
  store i64 %783, ptr %9, align 16
  store i64 %786, ptr %35, align 8
  br label %936

930:
  %931 = getelementptr inbounds i8, ptr %782, i64 16
  %932 = load i64, ptr %931, align 8
  %933 = getelementptr inbounds i8, ptr %782, i64 24
  %934 = load i64, ptr %933, align 8
  %935 = icmp slt i64 %932, %934
  br i1 %935, label %1019, label %1017

936:
  %937 = phi i64 [ %780, %929 ], [ %1014, %1013 ]
  %938 = phi i64 [ 0, %929 ], [ %1015, %1013 ]
  %939 = getelementptr inbounds i8, ptr %9, i64 %938
  %940 = load i64, ptr %939, align 8
  %941 = shl nuw i64 1, %940
  %942 = and i64 %941, %937
  %943 = icmp eq i64 %942, 0
  br i1 %943, label %944, label %1013

944:
  %945 = or i64 %941, %937
  %946 = getelementptr inbounds i64, ptr %193, i64 %940
  %947 = load i64, ptr %946, align 8
  %948 = getelementptr i8, ptr %946, i64 8
  %949 = load i64, ptr %948, align 8
  %950 = icmp slt i64 %947, %949
  br i1 %950, label %951, label %1013

951:
  %952 = getelementptr inbounds %struct.Frame.2, ptr %13, i64 %940
  %953 = getelementptr inbounds i8, ptr %952, i64 576
  %954 = load <8 x double>, ptr %953, align 64
  %955 = load <8 x double>, ptr %952, align 64
  %956 = getelementptr inbounds i8, ptr %952, i64 64
  %957 = load <8 x double>, ptr %956, align 64
  %958 = getelementptr inbounds i8, ptr %952, i64 128
  %959 = load <8 x double>, ptr %958, align 64
  %960 = getelementptr inbounds i8, ptr %952, i64 640
  %961 = load <8 x double>, ptr %960, align 64
  %962 = getelementptr inbounds i8, ptr %952, i64 192
  %963 = load <8 x double>, ptr %962, align 64
  %964 = getelementptr inbounds i8, ptr %952, i64 256
  %965 = load <8 x double>, ptr %964, align 64
  %966 = getelementptr inbounds i8, ptr %952, i64 320
  %967 = load <8 x double>, ptr %966, align 64
  %968 = getelementptr inbounds i8, ptr %952, i64 704
  %969 = load <8 x double>, ptr %968, align 64
  %970 = getelementptr inbounds i8, ptr %952, i64 384
  %971 = load <8 x double>, ptr %970, align 64
  %972 = getelementptr inbounds i8, ptr %952, i64 448
  %973 = load <8 x double>, ptr %972, align 64
  %974 = getelementptr inbounds i8, ptr %952, i64 512
  %975 = load <8 x double>, ptr %974, align 64
  br label %976

976:
  %977 = phi i64 [ %947, %951 ], [ %1011, %976 ]
  %978 = getelementptr inbounds %struct.Part.7, ptr %194, i64 %977
  %979 = load double, ptr %978, align 8
  %980 = getelementptr inbounds i8, ptr %978, i64 8
  %981 = load double, ptr %980, align 8
  %982 = getelementptr inbounds i8, ptr %978, i64 16
  %983 = load double, ptr %982, align 8
  %984 = insertelement <8 x double> poison, double %979, i64 0
  %985 = shufflevector <8 x double> %984, <8 x double> poison, <8 x i32> zeroinitializer
  %986 = fmul contract <8 x double> %955, %985
  %987 = fadd contract <8 x double> %954, %986
  %988 = insertelement <8 x double> poison, double %981, i64 0
  %989 = shufflevector <8 x double> %988, <8 x double> poison, <8 x i32> zeroinitializer
  %990 = fmul contract <8 x double> %957, %989
  %991 = fadd contract <8 x double> %987, %990
  %992 = insertelement <8 x double> poison, double %983, i64 0
  %993 = shufflevector <8 x double> %992, <8 x double> poison, <8 x i32> zeroinitializer
  %994 = fmul contract <8 x double> %959, %993
  %995 = fadd contract <8 x double> %991, %994
  %996 = fmul contract <8 x double> %963, %985
  %997 = fadd contract <8 x double> %961, %996
  %998 = fmul contract <8 x double> %965, %989
  %999 = fadd contract <8 x double> %997, %998
  %1000 = fmul contract <8 x double> %967, %993
  %1001 = fadd contract <8 x double> %999, %1000
  %1002 = fmul contract <8 x double> %971, %985
  %1003 = fadd contract <8 x double> %969, %1002
  %1004 = fmul contract <8 x double> %973, %989
  %1005 = fadd contract <8 x double> %1003, %1004
  %1006 = fmul contract <8 x double> %975, %993
  %1007 = fadd contract <8 x double> %1005, %1006
  %1008 = getelementptr inbounds [192 x %struct.Point.4], ptr %8, i64 0, i64 %977
  store <8 x double> %995, ptr %1008, align 64
  %1009 = getelementptr inbounds i8, ptr %1008, i64 64
  store <8 x double> %1001, ptr %1009, align 64
  %1010 = getelementptr inbounds i8, ptr %1008, i64 128
  store <8 x double> %1007, ptr %1010, align 64
  %1011 = add nsw i64 %977, 1
  %1012 = icmp eq i64 %1011, %949
  br i1 %1012, label %1013, label %976

1013:
  %1014 = phi i64 [ %937, %936 ], [ %945, %944 ], [ %945, %976 ]
  %1015 = add nuw nsw i64 %938, 8
  %1016 = icmp eq i64 %1015, 16
  br i1 %1016, label %930, label %936

1017:
  %1018 = phi <8 x i64> [ %779, %930 ], [ %1275, %1272 ]
  call void @llvm.lifetime.end.p0(i64 16, ptr nonnull %9)
  br label %1278

1019:
  %1020 = phi <8 x i64> [ %1275, %1272 ], [ %779, %930 ]
  %1021 = phi i64 [ %1276, %1272 ], [ %932, %930 ]
  %1022 = phi i1 [ %1273, %1272 ], [ false, %930 ]
  %1023 = phi i64 [ %1274, %1272 ], [ -1, %930 ]
  %1024 = getelementptr inbounds %struct.PartPair, ptr %195, i64 %1021
  %1025 = load i64, ptr %1024, align 8
  %1026 = getelementptr inbounds %struct.Part.7, ptr %194, i64 %1025
  %1027 = getelementptr inbounds i8, ptr %1024, i64 8
  %1028 = load i64, ptr %1027, align 8
  %1029 = getelementptr inbounds %struct.Part.7, ptr %194, i64 %1028
  %1030 = icmp eq i64 %1025, %1023
  br i1 %1030, label %1058, label %1031

1031:
  %1032 = getelementptr inbounds i8, ptr %1026, i64 56
  %1033 = load double, ptr %1032, align 8
  %1034 = fadd contract double %858, %1033
  %1035 = insertelement <8 x double> poison, double %1034, i64 0
  %1036 = shufflevector <8 x double> %1035, <8 x double> poison, <8 x i32> zeroinitializer
  %1037 = fadd contract <8 x double> %802, %1036
  %1038 = fcmp contract ogt <8 x double> %1037, %774
  %1039 = select contract <8 x i1> %1038, <8 x double> %1037, <8 x double> %774
  %1040 = getelementptr inbounds [192 x %struct.Point.4], ptr %8, i64 0, i64 %1025
  %1041 = load <8 x double>, ptr %1040, align 64
  %1042 = fsub contract <8 x double> %1041, %826
  %1043 = getelementptr inbounds i8, ptr %1040, i64 64
  %1044 = load <8 x double>, ptr %1043, align 64
  %1045 = fsub contract <8 x double> %1044, %840
  %1046 = getelementptr inbounds i8, ptr %1040, i64 128
  %1047 = load <8 x double>, ptr %1046, align 64
  %1048 = fsub contract <8 x double> %1047, %854
  %1049 = fmul contract <8 x double> %1042, %1042
  %1050 = fmul contract <8 x double> %1045, %1045
  %1051 = fadd contract <8 x double> %1049, %1050
  %1052 = fmul contract <8 x double> %1048, %1048
  %1053 = fadd contract <8 x double> %1051, %1052
  %1054 = fmul contract <8 x double> %1039, %1039
  %1055 = fcmp contract olt <8 x double> %1053, %1054
  %1056 = bitcast <8 x i1> %1055 to i8
  %1057 = icmp eq i8 %1056, 0
  br i1 %1057, label %1272, label %1068

1058:
  br i1 %1022, label %1059, label %1272

1059:
  %1060 = getelementptr inbounds i8, ptr %1026, i64 56
  %1061 = load double, ptr %1060, align 8
  %1062 = getelementptr inbounds [192 x %struct.Point.4], ptr %8, i64 0, i64 %1023
  %1063 = load <8 x double>, ptr %1062, align 64
  %1064 = getelementptr inbounds i8, ptr %1062, i64 64
  %1065 = load <8 x double>, ptr %1064, align 64
  %1066 = getelementptr inbounds i8, ptr %1062, i64 128
  %1067 = load <8 x double>, ptr %1066, align 64
  br label %1068

1068:
  %1069 = phi <8 x double> [ %1047, %1031 ], [ %1067, %1059 ]
  %1070 = phi <8 x double> [ %1044, %1031 ], [ %1065, %1059 ]
  %1071 = phi <8 x double> [ %1041, %1031 ], [ %1063, %1059 ]
  %1072 = phi double [ %1033, %1031 ], [ %1061, %1059 ]
  %1073 = phi i64 [ %1025, %1031 ], [ %1023, %1059 ]
  %1074 = getelementptr inbounds i8, ptr %1029, i64 56
  %1075 = load double, ptr %1074, align 8
  %1076 = fadd contract double %1072, %1075
  %1077 = insertelement <8 x double> poison, double %1076, i64 0
  %1078 = shufflevector <8 x double> %1077, <8 x double> poison, <8 x i32> zeroinitializer
  %1079 = fadd contract <8 x double> %802, %1078
  %1080 = fcmp contract ogt <8 x double> %1079, %774
  %1081 = select contract <8 x i1> %1080, <8 x double> %1079, <8 x double> %774
  %1082 = getelementptr inbounds [192 x %struct.Point.4], ptr %8, i64 0, i64 %1028
  %1083 = load <8 x double>, ptr %1082, align 64
  %1084 = fsub contract <8 x double> %1071, %1083
  %1085 = getelementptr inbounds i8, ptr %1082, i64 64
  %1086 = load <8 x double>, ptr %1085, align 64
  %1087 = fsub contract <8 x double> %1070, %1086
  %1088 = getelementptr inbounds i8, ptr %1082, i64 128
  %1089 = load <8 x double>, ptr %1088, align 64
  %1090 = fsub contract <8 x double> %1069, %1089
  %1091 = fmul contract <8 x double> %1084, %1084
  %1092 = fmul contract <8 x double> %1087, %1087
  %1093 = fadd contract <8 x double> %1091, %1092
  %1094 = fmul contract <8 x double> %1090, %1090
  %1095 = fadd contract <8 x double> %1093, %1094
  %1096 = fmul contract <8 x double> %1081, %1081
  %1097 = fcmp contract olt <8 x double> %1095, %1096
  %1098 = bitcast <8 x i1> %1097 to i8
  %1099 = icmp eq i8 %1098, 0
  br i1 %1099, label %1272, label %1100

1100:
  %1101 = getelementptr inbounds i8, ptr %1026, i64 48
  %1102 = load double, ptr %1101, align 8
  %1103 = getelementptr inbounds i8, ptr %1029, i64 48
  %1104 = load double, ptr %1103, align 8
  %1105 = fadd contract double %1102, %1104
  %1106 = insertelement <8 x double> poison, double %1105, i64 0
  %1107 = shufflevector <8 x double> %1106, <8 x double> poison, <8 x i32> zeroinitializer
  %1108 = fadd contract <8 x double> %802, %1107
  %1109 = fcmp contract ogt <8 x double> %1108, %774
  %1110 = select contract <8 x i1> %1109, <8 x double> %1108, <8 x double> %774
  %1111 = getelementptr inbounds i8, ptr %1026, i64 24
  %1112 = load double, ptr %1111, align 8
  %1113 = fmul contract double %1112, %1112
  %1114 = getelementptr inbounds i8, ptr %1026, i64 32
  %1115 = load double, ptr %1114, align 8
  %1116 = fmul contract double %1115, %1115
  %1117 = fadd contract double %1113, %1116
  %1118 = getelementptr inbounds i8, ptr %1026, i64 40
  %1119 = load double, ptr %1118, align 8
  %1120 = fmul contract double %1119, %1119
  %1121 = fadd contract double %1117, %1120
  %1122 = getelementptr inbounds i8, ptr %1029, i64 24
  %1123 = load double, ptr %1122, align 8
  %1124 = fmul contract double %1123, %1123
  %1125 = getelementptr inbounds i8, ptr %1029, i64 32
  %1126 = load double, ptr %1125, align 8
  %1127 = fmul contract double %1126, %1126
  %1128 = fadd contract double %1124, %1127
  %1129 = getelementptr inbounds i8, ptr %1029, i64 40
  %1130 = load double, ptr %1129, align 8
  %1131 = fmul contract double %1130, %1130
  %1132 = fadd contract double %1128, %1131
  %1133 = fcmp contract oeq double %1121, 0.000000e+00
  %1134 = fcmp contract oeq double %1132, 0.000000e+00
  %1135 = select i1 %1133, i1 %1134, i1 false
  br i1 %1135, label %1267, label %1136

1136:
  %1137 = fmul contract <8 x double> %1071, zeroinitializer
  %1138 = fadd contract <8 x double> %1137, <double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01>
  %1139 = insertelement <8 x double> poison, double %1112, i64 0
  %1140 = shufflevector <8 x double> %1139, <8 x double> poison, <8 x i32> zeroinitializer
  %1141 = fmul contract <8 x double> %872, %1140
  %1142 = insertelement <8 x double> poison, double %1115, i64 0
  %1143 = shufflevector <8 x double> %1142, <8 x double> poison, <8 x i32> zeroinitializer
  %1144 = fmul contract <8 x double> %878, %1143
  %1145 = fadd contract <8 x double> %1141, %1144
  %1146 = insertelement <8 x double> poison, double %1119, i64 0
  %1147 = shufflevector <8 x double> %1146, <8 x double> poison, <8 x i32> zeroinitializer
  %1148 = fmul contract <8 x double> %884, %1147
  %1149 = fadd contract <8 x double> %1145, %1148
  %1150 = fmul contract <8 x double> %892, %1140
  %1151 = fmul contract <8 x double> %896, %1143
  %1152 = fadd contract <8 x double> %1150, %1151
  %1153 = fmul contract <8 x double> %900, %1147
  %1154 = fadd contract <8 x double> %1152, %1153
  %1155 = fmul contract <8 x double> %906, %1140
  %1156 = fmul contract <8 x double> %910, %1143
  %1157 = fadd contract <8 x double> %1155, %1156
  %1158 = fmul contract <8 x double> %914, %1147
  %1159 = fadd contract <8 x double> %1157, %1158
  %1160 = insertelement <8 x double> poison, double %1123, i64 0
  %1161 = shufflevector <8 x double> %1160, <8 x double> poison, <8 x i32> zeroinitializer
  %1162 = fmul contract <8 x double> %810, %1161
  %1163 = insertelement <8 x double> poison, double %1126, i64 0
  %1164 = shufflevector <8 x double> %1163, <8 x double> poison, <8 x i32> zeroinitializer
  %1165 = fmul contract <8 x double> %816, %1164
  %1166 = fadd contract <8 x double> %1162, %1165
  %1167 = insertelement <8 x double> poison, double %1130, i64 0
  %1168 = shufflevector <8 x double> %1167, <8 x double> poison, <8 x i32> zeroinitializer
  %1169 = fmul contract <8 x double> %822, %1168
  %1170 = fadd contract <8 x double> %1166, %1169
  %1171 = fmul contract <8 x double> %830, %1161
  %1172 = fmul contract <8 x double> %834, %1164
  %1173 = fadd contract <8 x double> %1171, %1172
  %1174 = fmul contract <8 x double> %838, %1168
  %1175 = fadd contract <8 x double> %1173, %1174
  %1176 = fmul contract <8 x double> %844, %1161
  %1177 = fmul contract <8 x double> %848, %1164
  %1178 = fadd contract <8 x double> %1176, %1177
  %1179 = fmul contract <8 x double> %852, %1168
  %1180 = fadd contract <8 x double> %1178, %1179
  %1181 = fcmp contract ogt double %1121, 0.000000e+00
  %1182 = fdiv contract double 1.000000e+00, %1121
  %1183 = select contract i1 %1181, double %1182, double 0.000000e+00
  %1184 = fcmp contract ogt double %1132, 0.000000e+00
  %1185 = fdiv contract double 1.000000e+00, %1132
  %1186 = select contract i1 %1184, double %1185, double 0.000000e+00
  %1187 = fmul contract <8 x double> %1149, %1170
  %1188 = fmul contract <8 x double> %1154, %1175
  %1189 = fadd contract <8 x double> %1187, %1188
  %1190 = fmul contract <8 x double> %1159, %1180
  %1191 = fadd contract <8 x double> %1190, %1189
  %1192 = fmul contract <8 x double> %1084, %1149
  %1193 = fmul contract <8 x double> %1087, %1154
  %1194 = fadd contract <8 x double> %1192, %1193
  %1195 = fmul contract <8 x double> %1090, %1159
  %1196 = fadd contract <8 x double> %1195, %1194
  %1197 = fmul contract <8 x double> %1084, %1170
  %1198 = fmul contract <8 x double> %1087, %1175
  %1199 = fadd contract <8 x double> %1197, %1198
  %1200 = fmul contract <8 x double> %1090, %1180
  %1201 = fadd contract <8 x double> %1200, %1199
  %1202 = fmul contract double %1121, %1132
  %1203 = insertelement <8 x double> poison, double %1202, i64 0
  %1204 = shufflevector <8 x double> %1203, <8 x double> poison, <8 x i32> zeroinitializer
  %1205 = fmul contract <8 x double> %1191, %1191
  %1206 = fsub contract <8 x double> %1204, %1205
  %1207 = fmul contract double %1121, 0x3E7AD7F29ABCAF48
  %1208 = fmul contract double %1207, %1132
  %1209 = insertelement <8 x double> poison, double %1208, i64 0
  %1210 = shufflevector <8 x double> %1209, <8 x double> poison, <8 x i32> zeroinitializer
  %1211 = fcmp contract ogt <8 x double> %1206, %1210
  %1212 = fmul contract <8 x double> %1191, %1201
  %1213 = insertelement <8 x double> poison, double %1132, i64 0
  %1214 = shufflevector <8 x double> %1213, <8 x double> poison, <8 x i32> zeroinitializer
  %1215 = fmul contract <8 x double> %1214, %1196
  %1216 = fsub contract <8 x double> %1212, %1215
  %1217 = select contract <8 x i1> %1211, <8 x double> %1206, <8 x double> %1138
  %1218 = fdiv contract <8 x double> %1216, %1217
  %1219 = fneg contract <8 x double> %1138
  %1220 = fcmp contract ogt <8 x double> %1218, %1219
  %1221 = select contract <8 x i1> %1220, <8 x double> %1218, <8 x double> %1219
  %1222 = fcmp contract olt <8 x double> %1221, %1138
  %1223 = select contract <8 x i1> %1222, <8 x double> %1221, <8 x double> %1138
  %1224 = select contract <8 x i1> %1211, <8 x double> %1223, <8 x double> %1219
  %1225 = fmul contract <8 x double> %1191, %1224
  %1226 = fadd contract <8 x double> %1201, %1225
  %1227 = insertelement <8 x double> poison, double %1186, i64 0
  %1228 = shufflevector <8 x double> %1227, <8 x double> poison, <8 x i32> zeroinitializer
  %1229 = fmul contract <8 x double> %1228, %1226
  %1230 = fcmp contract ogt <8 x double> %1229, %1219
  %1231 = select contract <8 x i1> %1230, <8 x double> %1229, <8 x double> %1219
  %1232 = fcmp contract olt <8 x double> %1231, %1138
  %1233 = select contract <8 x i1> %1232, <8 x double> %1231, <8 x double> %1138
  %1234 = fmul contract <8 x double> %1191, %1233
  %1235 = fsub contract <8 x double> %1234, %1196
  %1236 = insertelement <8 x double> poison, double %1183, i64 0
  %1237 = shufflevector <8 x double> %1236, <8 x double> poison, <8 x i32> zeroinitializer
  %1238 = fmul contract <8 x double> %1237, %1235
  %1239 = fcmp contract ogt <8 x double> %1238, %1219
  %1240 = select contract <8 x i1> %1239, <8 x double> %1238, <8 x double> %1219
  %1241 = fcmp contract olt <8 x double> %1240, %1138
  %1242 = select contract <8 x i1> %1241, <8 x double> %1240, <8 x double> %1138
  %1243 = fmul contract <8 x double> %1191, %1242
  %1244 = fadd contract <8 x double> %1201, %1243
  %1245 = fmul contract <8 x double> %1228, %1244
  %1246 = fcmp contract ogt <8 x double> %1245, %1219
  %1247 = select contract <8 x i1> %1246, <8 x double> %1245, <8 x double> %1219
  %1248 = fcmp contract olt <8 x double> %1247, %1138
  %1249 = select contract <8 x i1> %1248, <8 x double> %1247, <8 x double> %1138
  %1250 = fmul contract <8 x double> %1149, %1242
  %1251 = fadd contract <8 x double> %1084, %1250
  %1252 = fmul contract <8 x double> %1170, %1249
  %1253 = fsub contract <8 x double> %1251, %1252
  %1254 = fmul contract <8 x double> %1154, %1242
  %1255 = fadd contract <8 x double> %1087, %1254
  %1256 = fmul contract <8 x double> %1175, %1249
  %1257 = fsub contract <8 x double> %1255, %1256
  %1258 = fmul contract <8 x double> %1159, %1242
  %1259 = fadd contract <8 x double> %1090, %1258
  %1260 = fmul contract <8 x double> %1180, %1249
  %1261 = fsub contract <8 x double> %1259, %1260
  %1262 = fmul contract <8 x double> %1253, %1253
  %1263 = fmul contract <8 x double> %1257, %1257
  %1264 = fadd contract <8 x double> %1262, %1263
  %1265 = fmul contract <8 x double> %1261, %1261
  %1266 = fadd contract <8 x double> %1265, %1264
  br label %1267

1267:
  %1268 = phi <8 x double> [ %1266, %1136 ], [ %1095, %1100 ]
  %1269 = fmul contract <8 x double> %1110, %1110
  %1270 = fcmp contract olt <8 x double> %1268, %1269
  %1271 = select <8 x i1> %1270, <8 x i64> <i64 -1, i64 -1, i64 -1, i64 -1, i64 -1, i64 -1, i64 -1, i64 -1>, <8 x i64> %1020
  br label %1272

1272:
  %1273 = phi i1 [ true, %1267 ], [ false, %1058 ], [ true, %1068 ], [ false, %1031 ]
  %1274 = phi i64 [ %1073, %1267 ], [ %1023, %1058 ], [ %1073, %1068 ], [ %1025, %1031 ]
  %1275 = phi <8 x i64> [ %1271, %1267 ], [ %1020, %1058 ], [ %1020, %1068 ], [ %1020, %1031 ]
  %1276 = add nsw i64 %1021, 1
  %1277 = icmp eq i64 %1276, %934
  br i1 %1277, label %1017, label %1019

1278:
  %1279 = phi i64 [ %1014, %1017 ], [ %780, %778 ]
  %1280 = phi <8 x i64> [ %1018, %1017 ], [ %779, %778 ]
  %1281 = add nuw nsw i64 %781, 1
  %1282 = icmp eq i64 %1281, %52
  br i1 %1282, label %776, label %778

1283:
  %1284 = phi <8 x i64> [ %777, %776 ], [ %664, %663 ]
  %1285 = icmp sgt i64 %207, 0
  br i1 %1285, label %1303, label %1333

1286:
  %1287 = phi <8 x double> [ %208, %206 ], [ %1297, %1286 ]
  %1288 = phi <8 x double> [ %209, %206 ], [ %1300, %1286 ]
  %1289 = phi i64 [ 0, %206 ], [ %1301, %1286 ]
  %1290 = icmp sgt i64 %207, %1289
  %1291 = xor i64 %1289, -1
  %1292 = select i1 %1290, i64 %1291, i64 -1
  %1293 = add i64 %1292, %207
  %1294 = getelementptr inbounds [4096 x %struct.Piece], ptr %12, i64 0, i64 %1293
  %1295 = getelementptr inbounds [8 x %struct.Piece], ptr %14, i64 0, i64 %1289
  call void @llvm.memcpy.p0.p0.i64(ptr noundef nonnull align 16 dereferenceable(16) %1295, ptr noundef nonnull align 16 dereferenceable(16) %1294, i64 16, i1 false)
  %1296 = load double, ptr %1295, align 16
  %1297 = insertelement <8 x double> %1287, double %1296, i64 %1289
  %1298 = getelementptr inbounds i8, ptr %1295, i64 8
  %1299 = load double, ptr %1298, align 8
  %1300 = insertelement <8 x double> %1288, double %1299, i64 %1289
  %1301 = add nuw nsw i64 %1289, 1
  %1302 = icmp eq i64 %1301, 8
  br i1 %1302, label %210, label %1286

1303:
  %1304 = phi i64 [ %1330, %1329 ], [ %225, %1283 ]
  %1305 = phi i64 [ %1331, %1329 ], [ 0, %1283 ]
  %1306 = extractelement <8 x i64> %1284, i64 %1305
  %1307 = icmp eq i64 %1306, 0
  br i1 %1307, label %1329, label %1308

1308:
  %1309 = getelementptr inbounds [8 x %struct.Piece], ptr %14, i64 0, i64 %1305
  %1310 = getelementptr inbounds i8, ptr %1309, i64 8
  %1311 = load double, ptr %1310, align 8
  %1312 = fmul contract double %179, %1311
  %1313 = fmul contract double %1312, 2.000000e+00
  %1314 = fcmp contract olt double %1313, %5
  %1315 = icmp sgt i64 %1304, 4094
  %1316 = select i1 %1314, i1 true, i1 %1315
  br i1 %1316, label %1317, label %1318

1317:
  call void @llvm.lifetime.end.p0(i64 128, ptr nonnull %14)
  br label %1336

1318:
  %1319 = fmul contract double %1311, 5.000000e-01
  %1320 = load double, ptr %1309, align 16
  %1321 = fsub contract double %1320, %1319
  %1322 = add nsw i64 %1304, 1
  %1323 = getelementptr inbounds [4096 x %struct.Piece], ptr %12, i64 0, i64 %1304
  store double %1321, ptr %1323, align 16
  %1324 = getelementptr inbounds i8, ptr %1323, i64 8
  store double %1319, ptr %1324, align 8
  %1325 = fadd contract double %1319, %1320
  %1326 = add nsw i64 %1304, 2
  %1327 = getelementptr inbounds [4096 x %struct.Piece], ptr %12, i64 0, i64 %1322
  store double %1325, ptr %1327, align 16
  %1328 = getelementptr inbounds i8, ptr %1327, i64 8
  store double %1319, ptr %1328, align 8
  br label %1329

1329:
  %1330 = phi i64 [ %1304, %1303 ], [ %1326, %1318 ]
  %1331 = add nuw nsw i64 %1305, 1
  %1332 = icmp eq i64 %1331, %224
  br i1 %1332, label %1333, label %1303

1333:
  %1334 = phi i64 [ %225, %1283 ], [ %1330, %1329 ]
  call void @llvm.lifetime.end.p0(i64 128, ptr nonnull %14)
  %1335 = icmp eq i64 %1334, 0
  br i1 %1335, label %1336, label %206

1336:
  %1337 = phi i8 [ 0, %1317 ], [ 1, %1333 ]
  call void @llvm.lifetime.end.p0(i64 13056, ptr nonnull %13)
  call void @llvm.lifetime.end.p0(i64 65536, ptr nonnull %12)
  call void @llvm.lifetime.end.p0(i64 2448, ptr nonnull %11)
  %1338 = getelementptr inbounds i8, ptr %6, i64 %41
  store i8 %1337, ptr %1338, align 1
  %1339 = add nuw nsw i64 %41, 1
  %1340 = icmp eq i64 %1339, %4
  br i1 %1340, label %39, label %40
}

define i64 @search_route(ptr nocapture noundef readonly %0, ptr nocapture noundef readonly %1, ptr nocapture noundef readonly %2, ptr nocapture noundef readonly %3, i64 noundef %4, i64 noundef %5, ptr nocapture noundef %6, ptr nocapture noundef writeonly %7) {
  %9 = alloca <16 x float>, align 64
  %10 = alloca <16 x float>, align 64
  %11 = alloca <16 x float>, align 64
  %12 = alloca <16 x float>, align 64
  %13 = alloca [2 x %struct.Tree], align 16
  %14 = alloca %struct.Random, align 8
  call void @llvm.lifetime.start.p0(i64 8, ptr nonnull %14)
  store i64 %5, ptr %14, align 8
  %15 = load <16 x float>, ptr %2, align 4
  call void @llvm.lifetime.start.p0(i64 48, ptr nonnull %13)
  %16 = getelementptr inbounds i8, ptr %1, i64 64
  %17 = load ptr, ptr %16, align 8
  store ptr %17, ptr %13, align 16
  %18 = getelementptr inbounds i8, ptr %13, i64 8
  %19 = getelementptr inbounds i8, ptr %1, i64 72
  %20 = load ptr, ptr %19, align 8
  store ptr %20, ptr %18, align 8
  %21 = getelementptr inbounds i8, ptr %13, i64 16
  %22 = getelementptr inbounds i8, ptr %13, i64 24
  %23 = getelementptr inbounds i8, ptr %1, i64 40
  %24 = load i64, ptr %23, align 8
  %25 = getelementptr inbounds <16 x float>, ptr %17, i64 %24
  store ptr %25, ptr %22, align 8
  %26 = getelementptr inbounds i8, ptr %13, i64 32
  %27 = getelementptr inbounds i32, ptr %20, i64 %24
  store ptr %27, ptr %26, align 16
  %28 = getelementptr inbounds i8, ptr %13, i64 40
  store i64 0, ptr %28, align 8
  store <16 x float> %15, ptr %17, align 4
  store i64 1, ptr %21, align 16
  store i32 -1, ptr %20, align 4
  %29 = icmp sgt i64 %4, 0
  br i1 %29, label %47, label %31

30:
  store i64 %4, ptr %28, align 8
  br label %31

31:
  %32 = load ptr, ptr %1, align 8
  %33 = load <16 x float>, ptr %32, align 4
  %34 = getelementptr inbounds i8, ptr %1, i64 8
  %35 = load ptr, ptr %34, align 8
  %36 = load <16 x float>, ptr %35, align 4
  %37 = getelementptr inbounds i8, ptr %1, i64 48
  %38 = load i64, ptr %37, align 8
  %39 = icmp sgt i64 %38, 0
  br i1 %39, label %40, label %433

40:
  %41 = getelementptr inbounds i8, ptr %1, i64 24
  %42 = getelementptr inbounds i8, ptr %1, i64 16
  %43 = getelementptr inbounds i8, ptr %1, i64 32
  %44 = getelementptr inbounds i8, ptr %1, i64 80
  %45 = getelementptr inbounds i8, ptr %1, i64 84
  %46 = getelementptr inbounds i8, ptr %1, i64 88
  br label %55

47:
  %48 = phi i64 [ %52, %47 ], [ 0, %8 ]
  %49 = getelementptr inbounds <16 x float>, ptr %3, i64 %48
  %50 = load <16 x float>, ptr %49, align 4
  %51 = getelementptr inbounds <16 x float>, ptr %25, i64 %48
  store <16 x float> %50, ptr %51, align 4
  %52 = add nuw nsw i64 %48, 1
  %53 = getelementptr inbounds i32, ptr %27, i64 %48
  store i32 -1, ptr %53, align 4
  %54 = icmp eq i64 %52, %4
  br i1 %54, label %30, label %47

55:
  %56 = phi i64 [ %38, %40 ], [ %430, %429 ]
  %57 = phi i64 [ %5, %40 ], [ %83, %429 ]
  %58 = phi i64 [ 0, %40 ], [ %431, %429 ]
  %59 = load i64, ptr %21, align 16
  %60 = load i64, ptr %28, align 8
  %61 = icmp sgt i64 %59, %60
  %62 = zext i1 %61 to i64
  %63 = getelementptr inbounds [2 x %struct.Tree], ptr %13, i64 0, i64 %62
  %64 = xor i1 %61, true
  %65 = zext i1 %64 to i64
  %66 = getelementptr inbounds [2 x %struct.Tree], ptr %13, i64 0, i64 %65
  %67 = getelementptr inbounds i8, ptr %63, i64 16
  %68 = load i64, ptr %67, align 8
  %69 = load i64, ptr %23, align 8
  %70 = icmp slt i64 %68, %69
  br i1 %70, label %71, label %433

71:
  %72 = getelementptr inbounds i8, ptr %66, i64 16
  %73 = load i64, ptr %72, align 8
  %74 = icmp slt i64 %73, %69
  br i1 %74, label %75, label %433

75:
  %76 = load i64, ptr %0, align 8
  %77 = icmp sgt i64 %76, 0
  br i1 %77, label %78, label %82

78:
  %79 = mul i64 %76, -7046029254386353131
  br label %185

80:
  %81 = add i64 %79, %57
  br label %82

82:
  %83 = phi i64 [ %57, %75 ], [ %81, %80 ]
  %84 = phi <16 x float> [ %33, %75 ], [ %205, %80 ]
  %85 = load ptr, ptr %63, align 8
  %86 = load ptr, ptr %41, align 8
  %87 = load <16 x float>, ptr %86, align 4
  %88 = fcmp contract oeq <16 x float> %87, zeroinitializer
  %89 = select contract <16 x i1> %88, <16 x float> <float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00>, <16 x float> zeroinitializer
  %90 = fadd contract <16 x float> %87, %89
  %91 = load ptr, ptr %42, align 8
  %92 = load <16 x float>, ptr %91, align 4
  %93 = icmp sgt i64 %68, 1
  br i1 %93, label %94, label %149

94:
  %95 = load <16 x float>, ptr %85, align 4
  %96 = fsub contract <16 x float> %84, %95
  %97 = fdiv contract <16 x float> %96, %90
  %98 = fadd contract <16 x float> %97, <float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000>
  %99 = fadd contract <16 x float> %98, <float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000>
  %100 = fmul contract <16 x float> %87, %99
  %101 = fsub contract <16 x float> %96, %100
  %102 = fmul contract <16 x float> %92, %101
  %103 = fmul contract <16 x float> %102, %102
  %104 = shufflevector <16 x float> %103, <16 x float> poison, <8 x i32> <i32 0, i32 1, i32 2, i32 3, i32 4, i32 5, i32 6, i32 7>
  %105 = shufflevector <16 x float> %103, <16 x float> poison, <8 x i32> <i32 8, i32 9, i32 10, i32 11, i32 12, i32 13, i32 14, i32 15>
  %106 = fadd contract <8 x float> %104, %105
  %107 = shufflevector <8 x float> %106, <8 x float> poison, <4 x i32> <i32 0, i32 1, i32 2, i32 3>
  %108 = shufflevector <8 x float> %106, <8 x float> poison, <4 x i32> <i32 4, i32 5, i32 6, i32 7>
  %109 = fadd contract <4 x float> %107, %108
  %110 = shufflevector <4 x float> %109, <4 x float> poison, <4 x i32> <i32 2, i32 poison, i32 poison, i32 poison>
  %111 = fadd contract <4 x float> %109, %110
  %112 = shufflevector <4 x float> %109, <4 x float> poison, <4 x i32> <i32 poison, i32 3, i32 poison, i32 poison>
  %113 = fadd contract <4 x float> %109, %112
  %114 = shufflevector <4 x float> %113, <4 x float> poison, <4 x i32> <i32 1, i32 poison, i32 poison, i32 poison>
  %115 = fadd contract <4 x float> %111, %114
  %116 = extractelement <4 x float> %115, i64 0
  br label %117

117:
  %118 = phi i64 [ %146, %117 ], [ 0, %94 ]
  %119 = phi i64 [ %147, %117 ], [ 1, %94 ]
  %120 = phi float [ %145, %117 ], [ %116, %94 ]
  %121 = getelementptr inbounds <16 x float>, ptr %85, i64 %119
  %122 = load <16 x float>, ptr %121, align 4
  %123 = fsub contract <16 x float> %84, %122
  %124 = fdiv contract <16 x float> %123, %90
  %125 = fadd contract <16 x float> %124, <float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000>
  %126 = fadd contract <16 x float> %125, <float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000>
  %127 = fmul contract <16 x float> %87, %126
  %128 = fsub contract <16 x float> %123, %127
  %129 = fmul contract <16 x float> %92, %128
  %130 = fmul contract <16 x float> %129, %129
  %131 = shufflevector <16 x float> %130, <16 x float> poison, <8 x i32> <i32 0, i32 1, i32 2, i32 3, i32 4, i32 5, i32 6, i32 7>
  %132 = shufflevector <16 x float> %130, <16 x float> poison, <8 x i32> <i32 8, i32 9, i32 10, i32 11, i32 12, i32 13, i32 14, i32 15>
  %133 = fadd contract <8 x float> %131, %132
  %134 = shufflevector <8 x float> %133, <8 x float> poison, <4 x i32> <i32 0, i32 1, i32 2, i32 3>
  %135 = shufflevector <8 x float> %133, <8 x float> poison, <4 x i32> <i32 4, i32 5, i32 6, i32 7>
  %136 = fadd contract <4 x float> %134, %135
  %137 = shufflevector <4 x float> %136, <4 x float> poison, <4 x i32> <i32 2, i32 poison, i32 poison, i32 poison>
  %138 = fadd contract <4 x float> %136, %137
  %139 = shufflevector <4 x float> %136, <4 x float> poison, <4 x i32> <i32 poison, i32 3, i32 poison, i32 poison>
  %140 = fadd contract <4 x float> %136, %139
  %141 = shufflevector <4 x float> %140, <4 x float> poison, <4 x i32> <i32 1, i32 poison, i32 poison, i32 poison>
  %142 = fadd contract <4 x float> %138, %141
  %143 = extractelement <4 x float> %142, i64 0
  %144 = fcmp contract olt float %143, %120
  %145 = select i1 %144, float %143, float %120
  %146 = select i1 %144, i64 %119, i64 %118
  %147 = add nuw nsw i64 %119, 1
  %148 = icmp eq i64 %147, %68
  br i1 %148, label %149, label %117

149:
  %150 = phi i64 [ 0, %82 ], [ %146, %117 ]
  %151 = getelementptr inbounds <16 x float>, ptr %85, i64 %150
  %152 = load <16 x float>, ptr %151, align 4
  %153 = fsub contract <16 x float> %84, %152
  %154 = fdiv contract <16 x float> %153, %90
  %155 = fadd contract <16 x float> %154, <float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000>
  %156 = fadd contract <16 x float> %155, <float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000>
  %157 = fmul contract <16 x float> %87, %156
  %158 = fsub contract <16 x float> %153, %157
  %159 = load i64, ptr %43, align 8
  %160 = icmp eq i64 %159, 0
  %161 = fmul contract <16 x float> %92, %158
  br i1 %160, label %162, label %178

162:
  %163 = fmul contract <16 x float> %161, %161
  %164 = shufflevector <16 x float> %163, <16 x float> poison, <8 x i32> <i32 0, i32 1, i32 2, i32 3, i32 4, i32 5, i32 6, i32 7>
  %165 = shufflevector <16 x float> %163, <16 x float> poison, <8 x i32> <i32 8, i32 9, i32 10, i32 11, i32 12, i32 13, i32 14, i32 15>
  %166 = fadd contract <8 x float> %164, %165
  %167 = shufflevector <8 x float> %166, <8 x float> poison, <4 x i32> <i32 0, i32 1, i32 2, i32 3>
  %168 = shufflevector <8 x float> %166, <8 x float> poison, <4 x i32> <i32 4, i32 5, i32 6, i32 7>
  %169 = fadd contract <4 x float> %167, %168
  %170 = shufflevector <4 x float> %169, <4 x float> poison, <4 x i32> <i32 2, i32 poison, i32 poison, i32 poison>
  %171 = fadd contract <4 x float> %169, %170
  %172 = shufflevector <4 x float> %169, <4 x float> poison, <4 x i32> <i32 poison, i32 3, i32 poison, i32 poison>
  %173 = fadd contract <4 x float> %169, %172
  %174 = shufflevector <4 x float> %173, <4 x float> poison, <4 x i32> <i32 1, i32 poison, i32 poison, i32 poison>
  %175 = fadd contract <4 x float> %171, %174
  %176 = extractelement <4 x float> %175, i64 0
  %177 = tail call contract float @llvm.sqrt.f32(float %176)
  br label %181

178:
  %179 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %161)
  %180 = tail call contract float @llvm.vector.reduce.fmax.v16f32(<16 x float> %179)
  br label %181

181:
  %182 = phi float [ %180, %178 ], [ %177, %162 ]
  %183 = load float, ptr %44, align 8
  %184 = fcmp contract ogt float %182, %183
  br i1 %184, label %208, label %213

185:
  %186 = phi i64 [ %192, %185 ], [ %57, %78 ]
  %187 = phi <16 x float> [ %205, %185 ], [ %33, %78 ]
  %188 = phi i64 [ %206, %185 ], [ 0, %78 ]
  %189 = extractelement <16 x float> %36, i64 %188
  %190 = extractelement <16 x float> %33, i64 %188
  %191 = fsub contract float %189, %190
  %192 = add i64 %186, -7046029254386353131
  %193 = lshr i64 %192, 30
  %194 = xor i64 %193, %192
  %195 = mul i64 %194, -4658895280553007687
  %196 = lshr i64 %195, 27
  %197 = xor i64 %196, %195
  %198 = mul i64 %197, -7723592293110705685
  %199 = lshr i64 %198, 40
  %200 = uitofp nneg i64 %199 to float
  %201 = fmul contract float %200, 0x3E70000000000000
  %202 = fmul contract float %191, %201
  %203 = extractelement <16 x float> %187, i64 %188
  %204 = fadd contract float %203, %202
  %205 = insertelement <16 x float> %187, float %204, i64 %188
  %206 = add nuw nsw i64 %188, 1
  %207 = icmp eq i64 %206, %76
  br i1 %207, label %80, label %185

208:
  %209 = fdiv contract float %183, %182
  %210 = insertelement <16 x float> poison, float %209, i64 0
  %211 = shufflevector <16 x float> %210, <16 x float> poison, <16 x i32> zeroinitializer
  %212 = fmul contract <16 x float> %158, %211
  br label %213

213:
  %214 = phi <16 x float> [ %212, %208 ], [ %158, %181 ]
  %215 = fcmp contract oeq float %182, 0.000000e+00
  br i1 %215, label %429, label %216

216:
  call void @llvm.lifetime.start.p0(i64 64, ptr nonnull %9)
  call void @llvm.lifetime.start.p0(i64 64, ptr nonnull %10)
  store <16 x float> %152, ptr %9, align 64
  store <16 x float> %214, ptr %10, align 64
  %217 = load float, ptr %45, align 4
  %218 = load float, ptr %46, align 8
  %219 = call fastcc noundef zeroext i1 @_ZL12is_edge_freeRK5SceneIfEPKfS4_ff(ptr noundef nonnull readonly align 8 dereferenceable(136) %0, ptr noundef nonnull %9, ptr noundef nonnull %10, float noundef %217, float noundef %218)
  call void @llvm.lifetime.end.p0(i64 64, ptr nonnull %9)
  call void @llvm.lifetime.end.p0(i64 64, ptr nonnull %10)
  br i1 %219, label %220, label %429

220:
  %221 = fadd contract <16 x float> %152, %214
  %222 = getelementptr inbounds <16 x float>, ptr %85, i64 %68
  store <16 x float> %221, ptr %222, align 4
  %223 = trunc i64 %150 to i32
  %224 = getelementptr inbounds i8, ptr %63, i64 8
  %225 = load ptr, ptr %224, align 8
  %226 = add nsw i64 %68, 1
  store i64 %226, ptr %67, align 8
  %227 = getelementptr inbounds i32, ptr %225, i64 %68
  store i32 %223, ptr %227, align 4
  %228 = getelementptr <16 x float>, ptr %85, i64 %226
  %229 = getelementptr i8, ptr %228, i64 -64
  %230 = load <16 x float>, ptr %229, align 4
  %231 = load ptr, ptr %66, align 8
  %232 = load ptr, ptr %41, align 8
  %233 = load <16 x float>, ptr %232, align 4
  %234 = fcmp contract oeq <16 x float> %233, zeroinitializer
  %235 = select contract <16 x i1> %234, <16 x float> <float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00>, <16 x float> zeroinitializer
  %236 = fadd contract <16 x float> %233, %235
  %237 = load ptr, ptr %42, align 8
  %238 = load <16 x float>, ptr %237, align 4
  %239 = icmp sgt i64 %73, 1
  br i1 %239, label %240, label %295

240:
  %241 = load <16 x float>, ptr %231, align 4
  %242 = fsub contract <16 x float> %230, %241
  %243 = fdiv contract <16 x float> %242, %236
  %244 = fadd contract <16 x float> %243, <float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000>
  %245 = fadd contract <16 x float> %244, <float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000>
  %246 = fmul contract <16 x float> %233, %245
  %247 = fsub contract <16 x float> %242, %246
  %248 = fmul contract <16 x float> %238, %247
  %249 = fmul contract <16 x float> %248, %248
  %250 = shufflevector <16 x float> %249, <16 x float> poison, <8 x i32> <i32 0, i32 1, i32 2, i32 3, i32 4, i32 5, i32 6, i32 7>
  %251 = shufflevector <16 x float> %249, <16 x float> poison, <8 x i32> <i32 8, i32 9, i32 10, i32 11, i32 12, i32 13, i32 14, i32 15>
  %252 = fadd contract <8 x float> %250, %251
  %253 = shufflevector <8 x float> %252, <8 x float> poison, <4 x i32> <i32 0, i32 1, i32 2, i32 3>
  %254 = shufflevector <8 x float> %252, <8 x float> poison, <4 x i32> <i32 4, i32 5, i32 6, i32 7>
  %255 = fadd contract <4 x float> %253, %254
  %256 = shufflevector <4 x float> %255, <4 x float> poison, <4 x i32> <i32 2, i32 poison, i32 poison, i32 poison>
  %257 = fadd contract <4 x float> %255, %256
  %258 = shufflevector <4 x float> %255, <4 x float> poison, <4 x i32> <i32 poison, i32 3, i32 poison, i32 poison>
  %259 = fadd contract <4 x float> %255, %258
  %260 = shufflevector <4 x float> %259, <4 x float> poison, <4 x i32> <i32 1, i32 poison, i32 poison, i32 poison>
  %261 = fadd contract <4 x float> %257, %260
  %262 = extractelement <4 x float> %261, i64 0
  br label %263

263:
  %264 = phi i64 [ %292, %263 ], [ 0, %240 ]
  %265 = phi i64 [ %293, %263 ], [ 1, %240 ]
  %266 = phi float [ %291, %263 ], [ %262, %240 ]
  %267 = getelementptr inbounds <16 x float>, ptr %231, i64 %265
  %268 = load <16 x float>, ptr %267, align 4
  %269 = fsub contract <16 x float> %230, %268
  %270 = fdiv contract <16 x float> %269, %236
  %271 = fadd contract <16 x float> %270, <float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000>
  %272 = fadd contract <16 x float> %271, <float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000>
  %273 = fmul contract <16 x float> %233, %272
  %274 = fsub contract <16 x float> %269, %273
  %275 = fmul contract <16 x float> %238, %274
  %276 = fmul contract <16 x float> %275, %275
  %277 = shufflevector <16 x float> %276, <16 x float> poison, <8 x i32> <i32 0, i32 1, i32 2, i32 3, i32 4, i32 5, i32 6, i32 7>
  %278 = shufflevector <16 x float> %276, <16 x float> poison, <8 x i32> <i32 8, i32 9, i32 10, i32 11, i32 12, i32 13, i32 14, i32 15>
  %279 = fadd contract <8 x float> %277, %278
  %280 = shufflevector <8 x float> %279, <8 x float> poison, <4 x i32> <i32 0, i32 1, i32 2, i32 3>
  %281 = shufflevector <8 x float> %279, <8 x float> poison, <4 x i32> <i32 4, i32 5, i32 6, i32 7>
  %282 = fadd contract <4 x float> %280, %281
  %283 = shufflevector <4 x float> %282, <4 x float> poison, <4 x i32> <i32 2, i32 poison, i32 poison, i32 poison>
  %284 = fadd contract <4 x float> %282, %283
  %285 = shufflevector <4 x float> %282, <4 x float> poison, <4 x i32> <i32 poison, i32 3, i32 poison, i32 poison>
  %286 = fadd contract <4 x float> %282, %285
  %287 = shufflevector <4 x float> %286, <4 x float> poison, <4 x i32> <i32 1, i32 poison, i32 poison, i32 poison>
  %288 = fadd contract <4 x float> %284, %287
  %289 = extractelement <4 x float> %288, i64 0
  %290 = fcmp contract olt float %289, %266
  %291 = select i1 %290, float %289, float %266
  %292 = select i1 %290, i64 %265, i64 %264
  %293 = add nuw nsw i64 %265, 1
  %294 = icmp eq i64 %293, %73
  br i1 %294, label %295, label %263

295:
  %296 = phi i64 [ 0, %220 ], [ %292, %263 ]
  %297 = getelementptr inbounds i8, ptr %66, i64 8
  br label %298

298:
  %299 = phi i64 [ %73, %295 ], [ %425, %424 ]
  %300 = phi i64 [ %296, %295 ], [ %426, %424 ]
  %301 = getelementptr inbounds <16 x float>, ptr %231, i64 %300
  %302 = load <16 x float>, ptr %301, align 4
  %303 = fsub contract <16 x float> %230, %302
  %304 = load ptr, ptr %41, align 8
  %305 = load <16 x float>, ptr %304, align 4
  %306 = fcmp contract oeq <16 x float> %305, zeroinitializer
  %307 = select contract <16 x i1> %306, <16 x float> <float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00>, <16 x float> zeroinitializer
  %308 = fadd contract <16 x float> %305, %307
  %309 = fdiv contract <16 x float> %303, %308
  %310 = fadd contract <16 x float> %309, <float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000>
  %311 = fadd contract <16 x float> %310, <float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000>
  %312 = fmul contract <16 x float> %305, %311
  %313 = fsub contract <16 x float> %303, %312
  %314 = load i64, ptr %43, align 8
  %315 = icmp eq i64 %314, 0
  %316 = load ptr, ptr %42, align 8
  %317 = load <16 x float>, ptr %316, align 4
  %318 = fmul contract <16 x float> %317, %313
  br i1 %315, label %319, label %335

319:
  %320 = fmul contract <16 x float> %318, %318
  %321 = shufflevector <16 x float> %320, <16 x float> poison, <8 x i32> <i32 0, i32 1, i32 2, i32 3, i32 4, i32 5, i32 6, i32 7>
  %322 = shufflevector <16 x float> %320, <16 x float> poison, <8 x i32> <i32 8, i32 9, i32 10, i32 11, i32 12, i32 13, i32 14, i32 15>
  %323 = fadd contract <8 x float> %321, %322
  %324 = shufflevector <8 x float> %323, <8 x float> poison, <4 x i32> <i32 0, i32 1, i32 2, i32 3>
  %325 = shufflevector <8 x float> %323, <8 x float> poison, <4 x i32> <i32 4, i32 5, i32 6, i32 7>
  %326 = fadd contract <4 x float> %324, %325
  %327 = shufflevector <4 x float> %326, <4 x float> poison, <4 x i32> <i32 2, i32 poison, i32 poison, i32 poison>
  %328 = fadd contract <4 x float> %326, %327
  %329 = shufflevector <4 x float> %326, <4 x float> poison, <4 x i32> <i32 poison, i32 3, i32 poison, i32 poison>
  %330 = fadd contract <4 x float> %326, %329
  %331 = shufflevector <4 x float> %330, <4 x float> poison, <4 x i32> <i32 1, i32 poison, i32 poison, i32 poison>
  %332 = fadd contract <4 x float> %328, %331
  %333 = extractelement <4 x float> %332, i64 0
  %334 = tail call contract float @llvm.sqrt.f32(float %333)
  br label %338

335:
  %336 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %318)
  %337 = tail call contract float @llvm.vector.reduce.fmax.v16f32(<16 x float> %336)
  br label %338

338:
  %339 = phi float [ %337, %335 ], [ %334, %319 ]
  %340 = load float, ptr %44, align 8
  %341 = fcmp contract ugt float %339, %340
  br i1 %341, label %342, label %347

342:
  %343 = fdiv contract float %340, %339
  %344 = insertelement <16 x float> poison, float %343, i64 0
  %345 = shufflevector <16 x float> %344, <16 x float> poison, <16 x i32> zeroinitializer
  %346 = fmul contract <16 x float> %313, %345
  br label %347

347:
  %348 = phi <16 x float> [ %313, %338 ], [ %346, %342 ]
  call void @llvm.lifetime.start.p0(i64 64, ptr nonnull %11)
  call void @llvm.lifetime.start.p0(i64 64, ptr nonnull %12)
  store <16 x float> %302, ptr %11, align 64
  store <16 x float> %348, ptr %12, align 64
  %349 = load float, ptr %45, align 4
  %350 = load float, ptr %46, align 8
  %351 = call fastcc noundef zeroext i1 @_ZL12is_edge_freeRK5SceneIfEPKfS4_ff(ptr noundef nonnull readonly align 8 dereferenceable(136) %0, ptr noundef nonnull %11, ptr noundef nonnull %12, float noundef %349, float noundef %350)
  call void @llvm.lifetime.end.p0(i64 64, ptr nonnull %11)
  call void @llvm.lifetime.end.p0(i64 64, ptr nonnull %12)
  br i1 %351, label %352, label %427

352:
  br i1 %341, label %414, label %353

353:
  %354 = select i1 %61, i64 %300, i64 %68
  %355 = select i1 %61, i64 %68, i64 %300
  %356 = icmp slt i64 %354, 0
  br i1 %356, label %375, label %362

357:
  %358 = lshr i64 %369, 1
  %359 = icmp eq i64 %364, 0
  br i1 %359, label %375, label %360

360:
  %361 = getelementptr <16 x float>, ptr %6, i64 %369
  br label %378

362:
  %363 = phi i64 [ %373, %366 ], [ %354, %353 ]
  %364 = phi i64 [ %369, %366 ], [ 0, %353 ]
  %365 = icmp eq i64 %364, 256
  br i1 %365, label %433, label %366

366:
  %367 = getelementptr inbounds <16 x float>, ptr %17, i64 %363
  %368 = load <16 x float>, ptr %367, align 4
  %369 = add nuw nsw i64 %364, 1
  %370 = getelementptr inbounds <16 x float>, ptr %6, i64 %364
  store <16 x float> %368, ptr %370, align 4
  %371 = getelementptr inbounds i32, ptr %20, i64 %363
  %372 = load i32, ptr %371, align 4
  %373 = zext nneg i32 %372 to i64
  %374 = icmp slt i32 %372, 0
  br i1 %374, label %357, label %362

375:
  %376 = phi i64 [ 1, %357 ], [ 0, %353 ], [ %369, %378 ]
  %377 = icmp slt i64 %355, 0
  br i1 %377, label %435, label %387

378:
  %379 = phi i64 [ 0, %360 ], [ %385, %378 ]
  %380 = xor i64 %379, -1
  %381 = getelementptr <16 x float>, ptr %361, i64 %380
  %382 = load <16 x float>, ptr %381, align 4
  %383 = getelementptr inbounds <16 x float>, ptr %6, i64 %379
  %384 = load <16 x float>, ptr %383, align 4
  store <16 x float> %384, ptr %381, align 4
  store <16 x float> %382, ptr %383, align 4
  %385 = add nuw nsw i64 %379, 1
  %386 = icmp eq i64 %385, %358
  br i1 %386, label %375, label %378

387:
  %388 = phi i64 [ %412, %391 ], [ %355, %375 ]
  %389 = phi i64 [ %409, %391 ], [ %376, %375 ]
  store i64 %388, ptr %7, align 8
  %390 = icmp eq i64 %389, 256
  br i1 %390, label %424, label %391

391:
  %392 = getelementptr <16 x float>, ptr %6, i64 %389
  %393 = getelementptr i8, ptr %392, i64 -64
  %394 = load <16 x float>, ptr %393, align 4
  %395 = getelementptr inbounds <16 x float>, ptr %25, i64 %388
  %396 = load <16 x float>, ptr %395, align 4
  %397 = fsub contract <16 x float> %396, %394
  %398 = load ptr, ptr %41, align 8
  %399 = load <16 x float>, ptr %398, align 4
  %400 = fcmp contract oeq <16 x float> %399, zeroinitializer
  %401 = select contract <16 x i1> %400, <16 x float> <float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00>, <16 x float> zeroinitializer
  %402 = fadd contract <16 x float> %399, %401
  %403 = fdiv contract <16 x float> %397, %402
  %404 = fadd contract <16 x float> %403, <float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000>
  %405 = fadd contract <16 x float> %404, <float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000>
  %406 = fmul contract <16 x float> %399, %405
  %407 = fsub contract <16 x float> %397, %406
  %408 = fadd contract <16 x float> %394, %407
  store <16 x float> %408, ptr %392, align 4
  %409 = add nuw nsw i64 %389, 1
  %410 = getelementptr inbounds i32, ptr %27, i64 %388
  %411 = load i32, ptr %410, align 4
  %412 = zext nneg i32 %411 to i64
  %413 = icmp slt i32 %411, 0
  br i1 %413, label %435, label %387

414:
  %415 = load i64, ptr %23, align 8
  %416 = icmp slt i64 %299, %415
  br i1 %416, label %417, label %427

417:
  %418 = fadd contract <16 x float> %302, %348
  %419 = getelementptr inbounds <16 x float>, ptr %231, i64 %299
  store <16 x float> %418, ptr %419, align 4
  %420 = trunc i64 %300 to i32
  %421 = load ptr, ptr %297, align 8
  %422 = add nsw i64 %299, 1
  store i64 %422, ptr %72, align 8
  %423 = getelementptr inbounds i32, ptr %421, i64 %299
  store i32 %420, ptr %423, align 4
  br label %424

424:
  %425 = phi i64 [ %422, %417 ], [ %299, %387 ]
  %426 = phi i64 [ %299, %417 ], [ %300, %387 ]
  br i1 %341, label %298, label %433

427:
  %428 = load i64, ptr %37, align 8
  br label %429

429:
  %430 = phi i64 [ %428, %427 ], [ %56, %216 ], [ %56, %213 ]
  %431 = add nuw nsw i64 %58, 1
  %432 = icmp slt i64 %431, %430
  br i1 %432, label %55, label %433

433:
  %434 = phi i64 [ 0, %31 ], [ -1, %362 ], [ -1, %424 ], [ 0, %429 ], [ 0, %71 ], [ 0, %55 ]
  call void @llvm.lifetime.end.p0(i64 48, ptr nonnull %13)
  br label %440

435:
  %436 = phi i64 [ %409, %391 ], [ %376, %375 ]
  store i64 %83, ptr %14, align 8
  call void @llvm.lifetime.end.p0(i64 48, ptr nonnull %13)
  %437 = icmp sgt i64 %436, 2
  br i1 %437, label %438, label %440

438:
  %439 = call fastcc noundef i64 @_ZL13shorten_routeRK5SceneIfERK7ProblemR6RandomPDv16_fx(ptr noundef nonnull align 8 dereferenceable(136) %0, ptr noundef nonnull align 8 dereferenceable(96) %1, ptr noundef nonnull align 8 dereferenceable(8) %14, ptr noundef %6, i64 noundef %436)
  br label %440

440:
  %441 = phi i64 [ %439, %438 ], [ %436, %435 ], [ %434, %433 ]
  call void @llvm.lifetime.end.p0(i64 8, ptr nonnull %14)
  ret i64 %441
}

define internal fastcc noundef i64 @_ZL13shorten_routeRK5SceneIfERK7ProblemR6RandomPDv16_fx(ptr nocapture noundef nonnull readonly align 8 dereferenceable(136) %0, ptr nocapture noundef nonnull readonly align 8 dereferenceable(96) %1, ptr nocapture noundef nonnull align 8 dereferenceable(8) %2, ptr nocapture noundef %3, i64 noundef %4) unnamed_addr {
  %6 = alloca <16 x float>, align 64
  %7 = alloca <16 x float>, align 64
  %8 = alloca <16 x float>, align 64
  %9 = alloca <16 x float>, align 64
  %10 = alloca [256 x float], align 16
  %11 = alloca float, align 4
  %12 = alloca float, align 4
  %13 = alloca i64, align 16
  %14 = alloca i64, align 8
  %15 = alloca <16 x float>, align 64
  %16 = alloca <16 x float>, align 64
  call void @llvm.lifetime.start.p0(i64 1024, ptr nonnull %10)
  %17 = icmp sgt i64 %4, 2
  br i1 %17, label %18, label %268

18:
  %19 = getelementptr inbounds i8, ptr %1, i64 84
  %20 = getelementptr inbounds i8, ptr %1, i64 88
  br label %21

21:
  %22 = phi i64 [ %4, %18 ], [ %66, %65 ]
  %23 = phi i64 [ 0, %18 ], [ %24, %65 ]
  %24 = add nuw nsw i64 %23, 1
  %25 = getelementptr inbounds <16 x float>, ptr %3, i64 %23
  %26 = load float, ptr %19, align 4
  %27 = load float, ptr %20, align 8
  br label %39

28:
  %29 = getelementptr inbounds i8, ptr %1, i64 56
  %30 = icmp sgt i64 %66, 2
  %31 = load i64, ptr %29, align 8
  %32 = icmp sgt i64 %31, 0
  %33 = select i1 %30, i1 %32, i1 false
  br i1 %33, label %34, label %268

34:
  %35 = getelementptr inbounds i8, ptr %1, i64 32
  %36 = getelementptr inbounds i8, ptr %1, i64 16
  %37 = getelementptr inbounds i8, ptr %1, i64 84
  %38 = getelementptr inbounds i8, ptr %1, i64 88
  br label %69

39:
  %40 = phi i64 [ %41, %43 ], [ %22, %21 ]
  %41 = add nsw i64 %40, -1
  %42 = icmp sgt i64 %41, %24
  br i1 %42, label %43, label %65

43:
  %44 = load <16 x float>, ptr %25, align 4
  %45 = getelementptr inbounds <16 x float>, ptr %3, i64 %41
  %46 = load <16 x float>, ptr %45, align 4
  %47 = fsub contract <16 x float> %46, %44
  call void @llvm.lifetime.start.p0(i64 64, ptr nonnull %6)
  call void @llvm.lifetime.start.p0(i64 64, ptr nonnull %7)
  store <16 x float> %44, ptr %6, align 64
  store <16 x float> %47, ptr %7, align 64
  %48 = call fastcc noundef zeroext i1 @_ZL12is_edge_freeRK5SceneIfEPKfS4_ff(ptr noundef nonnull align 8 dereferenceable(136) %0, ptr noundef nonnull %6, ptr noundef nonnull %7, float noundef %26, float noundef %27)
  call void @llvm.lifetime.end.p0(i64 64, ptr nonnull %6)
  call void @llvm.lifetime.end.p0(i64 64, ptr nonnull %7)
  br i1 %48, label %49, label %39

49:
  %50 = sub i64 1, %40
  %51 = icmp sgt i64 %40, %22
  br i1 %51, label %55, label %52

52:
  %53 = getelementptr <16 x float>, ptr %3, i64 %50
  %54 = getelementptr <16 x float>, ptr %53, i64 %24
  br label %58

55:
  %56 = add i64 %22, %24
  %57 = add i64 %56, %50
  br label %65

58:
  %59 = phi i64 [ %41, %52 ], [ %63, %58 ]
  %60 = getelementptr inbounds <16 x float>, ptr %3, i64 %59
  %61 = load <16 x float>, ptr %60, align 4
  %62 = getelementptr <16 x float>, ptr %54, i64 %59
  store <16 x float> %61, ptr %62, align 4
  %63 = add nsw i64 %59, 1
  %64 = icmp eq i64 %63, %22
  br i1 %64, label %55, label %58

65:
  %66 = phi i64 [ %57, %55 ], [ %22, %39 ]
  %67 = add nuw nsw i64 %23, 3
  %68 = icmp slt i64 %67, %66
  br i1 %68, label %21, label %28

69:
  %70 = phi i64 [ %66, %34 ], [ %263, %261 ]
  %71 = phi i64 [ 0, %34 ], [ %262, %261 ]
  store float 0.000000e+00, ptr %10, align 16
  %72 = load i64, ptr %35, align 8
  %73 = icmp eq i64 %72, 0
  %74 = load ptr, ptr %36, align 8
  %75 = load <16 x float>, ptr %3, align 4
  %76 = load <16 x float>, ptr %74, align 4
  br label %105

77:
  %78 = add nsw i64 %70, -1
  %79 = getelementptr inbounds [256 x float], ptr %10, i64 0, i64 %78
  %80 = load float, ptr %79, align 4
  call void @llvm.lifetime.start.p0(i64 4, ptr nonnull %11)
  call void @llvm.lifetime.start.p0(i64 4, ptr nonnull %12)
  %81 = load i64, ptr %2, align 8
  %82 = add i64 %81, -7046029254386353131
  %83 = lshr i64 %82, 30
  %84 = xor i64 %83, %82
  %85 = mul i64 %84, -4658895280553007687
  %86 = lshr i64 %85, 27
  %87 = xor i64 %86, %85
  %88 = mul i64 %87, -7723592293110705685
  %89 = lshr i64 %88, 40
  %90 = uitofp nneg i64 %89 to float
  %91 = fmul contract float %90, 0x3E70000000000000
  %92 = fmul contract float %80, %91
  store float %92, ptr %11, align 4
  %93 = add i64 %81, 4354685564936845354
  store i64 %93, ptr %2, align 8
  %94 = lshr i64 %93, 30
  %95 = xor i64 %94, %93
  %96 = mul i64 %95, -4658895280553007687
  %97 = lshr i64 %96, 27
  %98 = xor i64 %97, %96
  %99 = mul i64 %98, -7723592293110705685
  %100 = lshr i64 %99, 40
  %101 = uitofp nneg i64 %100 to float
  %102 = fmul contract float %101, 0x3E70000000000000
  %103 = fmul contract float %80, %102
  store float %103, ptr %12, align 4
  %104 = fcmp contract ogt float %92, %103
  br i1 %104, label %138, label %139

105:
  %106 = phi <16 x float> [ %75, %69 ], [ %110, %132 ]
  %107 = phi float [ 0.000000e+00, %69 ], [ %134, %132 ]
  %108 = phi i64 [ 1, %69 ], [ %136, %132 ]
  %109 = getelementptr inbounds <16 x float>, ptr %3, i64 %108
  %110 = load <16 x float>, ptr %109, align 4
  %111 = fsub contract <16 x float> %110, %106
  %112 = fmul contract <16 x float> %111, %76
  br i1 %73, label %113, label %129

113:
  %114 = fmul contract <16 x float> %112, %112
  %115 = shufflevector <16 x float> %114, <16 x float> poison, <8 x i32> <i32 0, i32 1, i32 2, i32 3, i32 4, i32 5, i32 6, i32 7>
  %116 = shufflevector <16 x float> %114, <16 x float> poison, <8 x i32> <i32 8, i32 9, i32 10, i32 11, i32 12, i32 13, i32 14, i32 15>
  %117 = fadd contract <8 x float> %115, %116
  %118 = shufflevector <8 x float> %117, <8 x float> poison, <4 x i32> <i32 0, i32 1, i32 2, i32 3>
  %119 = shufflevector <8 x float> %117, <8 x float> poison, <4 x i32> <i32 4, i32 5, i32 6, i32 7>
  %120 = fadd contract <4 x float> %118, %119
  %121 = shufflevector <4 x float> %120, <4 x float> poison, <4 x i32> <i32 2, i32 poison, i32 poison, i32 poison>
  %122 = fadd contract <4 x float> %120, %121
  %123 = shufflevector <4 x float> %120, <4 x float> poison, <4 x i32> <i32 poison, i32 3, i32 poison, i32 poison>
  %124 = fadd contract <4 x float> %120, %123
  %125 = shufflevector <4 x float> %124, <4 x float> poison, <4 x i32> <i32 1, i32 poison, i32 poison, i32 poison>
  %126 = fadd contract <4 x float> %122, %125
  %127 = extractelement <4 x float> %126, i64 0
  %128 = tail call contract float @llvm.sqrt.f32(float %127)
  br label %132

129:
  %130 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %112)
  %131 = tail call contract float @llvm.vector.reduce.fmax.v16f32(<16 x float> %130)
  br label %132

132:
  %133 = phi float [ %131, %129 ], [ %128, %113 ]
  %134 = fadd contract float %107, %133
  %135 = getelementptr inbounds [256 x float], ptr %10, i64 0, i64 %108
  store float %134, ptr %135, align 4
  %136 = add nuw nsw i64 %108, 1
  %137 = icmp eq i64 %136, %70
  br i1 %137, label %77, label %105

138:
  store float %103, ptr %11, align 4
  store float %92, ptr %12, align 4
  br label %139

139:
  %140 = phi float [ %103, %138 ], [ %92, %77 ]
  %141 = phi float [ %92, %138 ], [ %103, %77 ]
  call void @llvm.lifetime.start.p0(i64 8, ptr nonnull %13)
  call void @llvm.lifetime.start.p0(i64 8, ptr nonnull %14)
  call void @llvm.lifetime.start.p0(i64 64, ptr nonnull %15)
  call void @llvm.lifetime.start.p0(i64 64, ptr nonnull %16)
  %142 = add nsw i64 %70, -2
  %143 = add nsw i64 %70, -1
  %144 = getelementptr inbounds [256 x float], ptr %10, i64 0, i64 %143
  br label %145

145:
  %146 = phi i1 [ true, %139 ], [ false, %213 ]
  %147 = phi ptr [ %15, %139 ], [ %16, %213 ]
  %148 = phi ptr [ %13, %139 ], [ %14, %213 ]
  %149 = phi ptr [ %11, %139 ], [ %12, %213 ]
  br label %190

150:
  %151 = fsub contract float %141, %140
  %152 = load <16 x float>, ptr %16, align 64
  %153 = load <16 x float>, ptr %15, align 64
  %154 = fsub contract <16 x float> %152, %153
  %155 = load i64, ptr %35, align 8
  %156 = icmp eq i64 %155, 0
  %157 = load ptr, ptr %36, align 8
  %158 = load <16 x float>, ptr %157, align 4
  %159 = fmul contract <16 x float> %154, %158
  br i1 %156, label %160, label %176

160:
  %161 = fmul contract <16 x float> %159, %159
  %162 = shufflevector <16 x float> %161, <16 x float> poison, <8 x i32> <i32 0, i32 1, i32 2, i32 3, i32 4, i32 5, i32 6, i32 7>
  %163 = shufflevector <16 x float> %161, <16 x float> poison, <8 x i32> <i32 8, i32 9, i32 10, i32 11, i32 12, i32 13, i32 14, i32 15>
  %164 = fadd contract <8 x float> %162, %163
  %165 = shufflevector <8 x float> %164, <8 x float> poison, <4 x i32> <i32 0, i32 1, i32 2, i32 3>
  %166 = shufflevector <8 x float> %164, <8 x float> poison, <4 x i32> <i32 4, i32 5, i32 6, i32 7>
  %167 = fadd contract <4 x float> %165, %166
  %168 = shufflevector <4 x float> %167, <4 x float> poison, <4 x i32> <i32 2, i32 poison, i32 poison, i32 poison>
  %169 = fadd contract <4 x float> %167, %168
  %170 = shufflevector <4 x float> %167, <4 x float> poison, <4 x i32> <i32 poison, i32 3, i32 poison, i32 poison>
  %171 = fadd contract <4 x float> %167, %170
  %172 = shufflevector <4 x float> %171, <4 x float> poison, <4 x i32> <i32 1, i32 poison, i32 poison, i32 poison>
  %173 = fadd contract <4 x float> %169, %172
  %174 = extractelement <4 x float> %173, i64 0
  %175 = tail call contract float @llvm.sqrt.f32(float %174)
  br label %179

176:
  %177 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %159)
  %178 = tail call contract float @llvm.vector.reduce.fmax.v16f32(<16 x float> %177)
  br label %179

179:
  %180 = phi float [ %178, %176 ], [ %175, %160 ]
  %181 = fsub contract float %151, %180
  %182 = load i64, ptr %13, align 16
  %183 = load i64, ptr %14, align 8
  %184 = icmp eq i64 %182, %183
  %185 = fmul contract float %80, 0x3F1A36E2E0000000
  %186 = fcmp contract olt float %181, %185
  %187 = select i1 %184, i1 true, i1 %186
  %188 = icmp sgt i64 %70, 254
  %189 = or i1 %188, %187
  br i1 %189, label %228, label %224

190:
  %191 = phi i64 [ %196, %195 ], [ 0, %145 ]
  %192 = icmp eq i64 %191, %142
  br i1 %192, label %193, label %195

193:
  %194 = load float, ptr %144, align 4
  br label %201

195:
  %196 = add nuw nsw i64 %191, 1
  %197 = getelementptr inbounds [256 x float], ptr %10, i64 0, i64 %196
  %198 = load float, ptr %197, align 4
  %199 = load float, ptr %149, align 4
  %200 = fcmp contract olt float %198, %199
  br i1 %200, label %190, label %201

201:
  %202 = phi float [ %194, %193 ], [ %198, %195 ]
  %203 = phi i64 [ %143, %193 ], [ %196, %195 ]
  %204 = phi i64 [ %142, %193 ], [ %191, %195 ]
  %205 = getelementptr inbounds [256 x float], ptr %10, i64 0, i64 %204
  %206 = load float, ptr %205, align 4
  %207 = fsub contract float %202, %206
  %208 = fcmp contract ogt float %207, 0.000000e+00
  br i1 %208, label %209, label %213

209:
  %210 = load float, ptr %149, align 4
  %211 = fsub contract float %210, %206
  %212 = fdiv contract float %211, %207
  br label %213

213:
  %214 = phi contract float [ %212, %209 ], [ 0.000000e+00, %201 ]
  %215 = getelementptr inbounds <16 x float>, ptr %3, i64 %204
  %216 = load <16 x float>, ptr %215, align 4
  %217 = insertelement <16 x float> poison, float %214, i64 0
  %218 = shufflevector <16 x float> %217, <16 x float> poison, <16 x i32> zeroinitializer
  %219 = getelementptr inbounds <16 x float>, ptr %3, i64 %203
  %220 = load <16 x float>, ptr %219, align 4
  %221 = fsub contract <16 x float> %220, %216
  %222 = fmul contract <16 x float> %218, %221
  %223 = fadd contract <16 x float> %216, %222
  store <16 x float> %223, ptr %147, align 64
  store i64 %204, ptr %148, align 8
  br i1 %146, label %145, label %150

224:
  call void @llvm.lifetime.start.p0(i64 64, ptr nonnull %8)
  call void @llvm.lifetime.start.p0(i64 64, ptr nonnull %9)
  store <16 x float> %153, ptr %8, align 64
  store <16 x float> %154, ptr %9, align 64
  %225 = load float, ptr %37, align 4
  %226 = load float, ptr %38, align 8
  %227 = call fastcc noundef zeroext i1 @_ZL12is_edge_freeRK5SceneIfEPKfS4_ff(ptr noundef nonnull align 8 dereferenceable(136) %0, ptr noundef nonnull %8, ptr noundef nonnull %9, float noundef %225, float noundef %226)
  call void @llvm.lifetime.end.p0(i64 64, ptr nonnull %8)
  call void @llvm.lifetime.end.p0(i64 64, ptr nonnull %9)
  br i1 %227, label %230, label %228

228:
  %229 = add nsw i64 %71, 1
  br label %261

230:
  %231 = fmul contract float %80, 0x3F847AE140000000
  %232 = fcmp contract ogt float %181, %231
  %233 = select i1 %232, i64 0, i64 %71
  %234 = sub i64 %182, %183
  %235 = add i64 %234, 2
  %236 = icmp sgt i64 %235, 0
  br i1 %236, label %240, label %237

237:
  %238 = add nsw i64 %183, 1
  %239 = icmp slt i64 %238, %70
  br i1 %239, label %249, label %256

240:
  %241 = icmp sgt i64 %78, %183
  br i1 %241, label %242, label %256

242:
  %243 = phi i64 [ %247, %242 ], [ %78, %240 ]
  %244 = getelementptr inbounds <16 x float>, ptr %3, i64 %243
  %245 = load <16 x float>, ptr %244, align 4
  %246 = getelementptr <16 x float>, ptr %244, i64 %235
  store <16 x float> %245, ptr %246, align 4
  %247 = add nsw i64 %243, -1
  %248 = icmp sgt i64 %247, %183
  br i1 %248, label %242, label %256

249:
  %250 = phi i64 [ %254, %249 ], [ %238, %237 ]
  %251 = getelementptr inbounds <16 x float>, ptr %3, i64 %250
  %252 = load <16 x float>, ptr %251, align 4
  %253 = getelementptr <16 x float>, ptr %251, i64 %235
  store <16 x float> %252, ptr %253, align 4
  %254 = add nsw i64 %250, 1
  %255 = icmp eq i64 %254, %70
  br i1 %255, label %256, label %249

256:
  %257 = getelementptr <16 x float>, ptr %3, i64 %182
  %258 = getelementptr i8, ptr %257, i64 64
  store <16 x float> %153, ptr %258, align 4
  %259 = getelementptr i8, ptr %257, i64 128
  store <16 x float> %152, ptr %259, align 4
  %260 = add nsw i64 %235, %70
  br label %261

261:
  %262 = phi i64 [ %229, %228 ], [ %233, %256 ]
  %263 = phi i64 [ %70, %228 ], [ %260, %256 ]
  call void @llvm.lifetime.end.p0(i64 64, ptr nonnull %15)
  call void @llvm.lifetime.end.p0(i64 64, ptr nonnull %16)
  call void @llvm.lifetime.end.p0(i64 8, ptr nonnull %13)
  call void @llvm.lifetime.end.p0(i64 8, ptr nonnull %14)
  call void @llvm.lifetime.end.p0(i64 4, ptr nonnull %11)
  call void @llvm.lifetime.end.p0(i64 4, ptr nonnull %12)
  %264 = icmp sgt i64 %263, 2
  %265 = load i64, ptr %29, align 8
  %266 = icmp slt i64 %262, %265
  %267 = select i1 %264, i1 %266, i1 false
  br i1 %267, label %69, label %268

268:
  %269 = phi i64 [ %66, %28 ], [ %4, %5 ], [ %263, %261 ]
  call void @llvm.lifetime.end.p0(i64 1024, ptr nonnull %10)
  ret i64 %269
}

define noundef i64 @shorten(ptr nocapture noundef nonnull readonly %0, ptr nocapture noundef nonnull readonly %1, ptr nocapture noundef %2, i64 noundef %3, i64 noundef %4) {
  %6 = alloca %struct.Random, align 8
  call void @llvm.lifetime.start.p0(i64 8, ptr nonnull %6)
  store i64 %4, ptr %6, align 8
  %7 = call fastcc noundef i64 @_ZL13shorten_routeRK5SceneIfERK7ProblemR6RandomPDv16_fx(ptr noundef nonnull align 8 dereferenceable(136) %0, ptr noundef nonnull align 8 dereferenceable(96) %1, ptr noundef nonnull align 8 dereferenceable(8) %6, ptr noundef %2, i64 noundef %3)
  call void @llvm.lifetime.end.p0(i64 8, ptr nonnull %6)
  ret i64 %7
}

declare <16 x float> @llvm.fabs.v16f32(<16 x float>)

declare void @llvm.memcpy.p0.p0.i64(ptr noalias nocapture writeonly, ptr noalias nocapture readonly, i64, i1 immarg)

declare <16 x float> @llvm.sqrt.v16f32(<16 x float>)

declare <8 x double> @llvm.fabs.v8f64(<8 x double>)

declare <8 x double> @llvm.sqrt.v8f64(<8 x double>)

declare float @llvm.sqrt.f32(float)

declare float @llvm.vector.reduce.fmax.v16f32(<16 x float>)

declare i64 @llvm.smin.i64(i64, i64)



